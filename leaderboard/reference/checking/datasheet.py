"""What is assumed of a reference and what was found, as one value from which everything else is read."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from enum import StrEnum

from leaderboard.models import Errata
from leaderboard.problems import Problem, Problems, Severity


class Status(StrEnum):
    """How an assumption fares.

    ``note`` is for what only informs: a finding that fails no check, or a fact of which nothing is expected.
    """

    OK = "ok"
    DEPARTS = "departs"
    NOTE = "note"
    ACCEPTED = "accepted"


@dataclass(frozen=True)
class Finding:
    """A problem of the reference; with a reason, errata accept it."""

    problem: Problem
    reason: str = ""

    @property
    def is_open(self) -> bool:
        """Whether nothing accepts it."""
        return not self.reason


@dataclass(frozen=True)
class Row:
    """One assumption: what is expected (empty where the definition says nothing), and what was found."""

    assumption: str
    expected: str
    found: str
    findings: tuple[Finding, ...] = ()

    @property
    def status(self) -> Status:
        """How it fares: as badly as the worst finding that nothing accepts."""
        severities = {finding.problem.severity for finding in self.findings if finding.is_open}
        if severities - {Severity.NOTE}:
            return Status.DEPARTS
        if severities:
            return Status.NOTE
        if self.findings:
            return Status.ACCEPTED
        return Status.OK if self.expected else Status.NOTE

    @property
    def code(self) -> str:
        """The code of its findings; empty without any."""
        return self.findings[0].problem.code if self.findings else ""


@dataclass(frozen=True)
class Section:
    """Assumptions that belong together; ``note`` says how they were judged, where that needs words."""

    title: str
    rows: tuple[Row, ...]
    note: str = ""


@dataclass(frozen=True)
class Datasheet:
    """All assumptions."""

    sections: tuple[Section, ...]

    @property
    def findings(self) -> tuple[Finding, ...]:
        """Every finding, in the order of the assumptions."""
        rows = (row for section in self.sections for row in section.rows)
        return tuple(finding for row in rows for finding in row.findings)

    @property
    def problems(self) -> tuple[Problem, ...]:
        """The findings that nothing accepts."""
        return tuple(finding.problem for finding in self.findings if finding.is_open)

    @property
    def accepted(self) -> tuple[Finding, ...]:
        """The findings that errata accept."""
        return tuple(finding for finding in self.findings if not finding.is_open)


def make_row(
    assumption: str, found: str, *, expected: str = "", problems: Problems | Iterable[Problem] = ()
) -> Row:
    """Put an assumption together with what was found against it."""
    return Row(assumption, expected, found, tuple(Finding(problem) for problem in problems))


def accept_findings(sections: Iterable[Section], errata: Errata) -> tuple[Section, ...]:
    """Give each finding that errata accept the reason of the first entry that does."""
    return tuple(
        replace(
            section,
            rows=tuple(
                replace(row, findings=tuple(_accept(finding.problem, errata) for finding in row.findings))
                for row in section.rows
            ),
        )
        for section in sections
    )


def is_accepted_by(problem: Problem, code: str, where: str) -> bool:
    """Tell whether an entry of errata is about a problem; errors cannot be accepted."""
    return problem.code == code and where in problem.message and not problem.is_error


def _accept(problem: Problem, errata: Errata) -> Finding:
    reasons = (e.reason for e in errata.accept if is_accepted_by(problem, e.code, e.where))
    return Finding(problem, next(reasons, ""))
