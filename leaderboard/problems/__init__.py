"""What can be wrong with a submission or a reference, as data: codes, problems, and a collector."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from leaderboard.problems import branches, imports, references, submissions
from leaderboard.problems.catalogue import Code, Severity

__all__ = ["CODES", "Code", "Problem", "Problems", "Severity"]

CODES: dict[str, Code] = {
    code: Code(severity, meaning)
    for part in (submissions, branches, references, imports)
    for severity, meanings in part.MEANINGS.items()
    for code, meaning in meanings.items()
}


@dataclass(frozen=True)
class Problem:
    """One thing that is wrong, where it is, and what to do about it.

    ``line`` is None where none applies; ``hint`` may be empty.
    """

    code: str
    message: str
    file: str
    line: int | None = None
    hint: str = ""

    @property
    def severity(self) -> Severity:
        """How much it matters, as the catalogue says."""
        return CODES[self.code].severity

    @property
    def is_error(self) -> bool:
        """Whether it refuses what it was found in."""
        return self.severity is Severity.ERROR


@dataclass
class Problems:
    """Collects the problems of one run in the order in which they are found."""

    found: list[Problem] = field(default_factory=list)

    def add(self, code: str, message: str, file: str, *, line: int | None = None, hint: str = "") -> None:
        """Note a problem; its code must be in the catalogue."""
        if code not in CODES:
            raise KeyError(code)
        self.found.append(Problem(code, message, file, line, hint))

    def extend_by_line(self, others: "Problems") -> None:
        """Take over the problems of one file in the order of its lines; those without a line come last."""
        self.found += sorted(others, key=lambda p: (p.line is None, p.line or 0))

    @property
    def has_errors(self) -> bool:
        """Whether any of them refuses the input."""
        return any(problem.is_error for problem in self.found)

    def __iter__(self) -> Iterator[Problem]:
        """Iterate in the order of finding."""
        return iter(self.found)

    def __len__(self) -> int:
        """Count them."""
        return len(self.found)
