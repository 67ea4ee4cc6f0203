"""What can be wrong with a submission or a reference, as data: codes, problems, and a collector."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import StrEnum


class Severity(StrEnum):
    """How much a problem matters: errors refuse, warnings and notes inform."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


@dataclass(frozen=True)
class Code:
    """One kind of problem: its severity and what it means, in one sentence for the docs."""

    severity: Severity
    meaning: str


CODES: dict[str, Code] = {}


def _define(severity: Severity, meanings: dict[str, str]) -> None:
    CODES.update({code: Code(severity, meaning) for code, meaning in meanings.items()})


# Submissions that are refused.
_define(
    Severity.ERROR,
    {
        "file-missing": "A file that every submission has is not there.",
        "unexpected-file": "A file or folder does not belong in a submission.",
        "not-a-plain-file": "A symbolic link, folder, pipe or device stands where a file should be.",
        "file-too-large": "A file is larger than any valid one.",
        "slug-malformed": "The folder's name cannot be a slug.",
        "slug-taken": "There is a submission of that slug already.",
        "not-text": "A file is an archive or another binary format.",
        "not-utf8": "A text file has another encoding than UTF-8.",
        "repeated-bom": "A text file starts with more than one byte-order mark.",
        "nul-byte": "A text file holds a NUL byte.",
        "line-ends": "A carriage return stands where no line ends.",
        "empty-file": "The predictions file is empty.",
        "wrong-separator": "Columns are separated by something other than a comma.",
        "wrong-header": "The first line is not the header that it must be.",
        "duplicate-column": "A column appears twice.",
        "repeated-header": "The header stands again among the rows.",
        "no-rows": "There is a header and nothing else.",
        "too-many-rows": "There are far more rows than trials.",
        "ragged-row": "A row has more or fewer cells than the header.",
        "malformed-quotes": "Quotes open and do not close, or stand where they may not.",
        "blank-line": "A line is empty.",
        "unknown-trial": "An id is not a trial of the benchmark.",
        "other-benchmark": "No id at all is a trial of the benchmark.",
        "duplicate-trial": "A trial is given twice.",
        "missing-trials": "A scenario is given in part.",
        "probability-missing": "A probability is empty without a status that says why.",
        "probability-not-a-number": "A probability is not a plain decimal number.",
        "probability-not-finite": "A probability is infinite or too large for a number.",
        "probability-underflow": "A probability is too small for a number without being 0.",
        "probability-out-of-range": "A probability lies outside 0 to 1.",
        "probability-percent": "A probability is written as a percentage.",
        "probability-decimal-comma": "A probability is written with a decimal comma.",
        "unknown-status": "A status is none of the known ones.",
        "contradicting-status": "A status says that there is no answer, and there is one.",
        "toml-syntax": "submission.toml is not TOML.",
        "unknown-key": "submission.toml has a key that means nothing.",
        "missing-key": "submission.toml lacks a key that it must have.",
        "wrong-type": "A value in submission.toml is of the wrong kind.",
        "unknown-value": "A value in submission.toml is none of the allowed ones.",
        "malformed-value": "A value in submission.toml breaks the rule for its key.",
        "text-too-long": "A text in submission.toml is longer than a page can show.",
        "forbidden-character": "A text in submission.toml holds a control or direction character.",
        "link-refused": "A link in submission.toml is not a plain web link.",
        "date-in-future": "The submission's date is later than tomorrow.",
        "no-track": "No track takes the submission's protocol.",
    },
)

# Submissions that are graded all the same.
_define(
    Severity.WARNING,
    {
        "constant-probabilities": "All probabilities are equal.",
        "equal-to-labels": "The probabilities are the labels.",
        "equal-to-human-means": "The probabilities are the shares of people who said YES.",
        "copy-of-another": "The probabilities are those of another team's submission, or nearly.",
        "swapped-copies": "Pairs are told apart, but the wrong way round more than chance would have it.",
        "beyond-track": "The model's inputs hold more than the track shows.",
    },
)

# References that cannot be used.
_define(
    Severity.ERROR,
    {
        "reference-file-missing": "A file that the reference needs is not there.",
        "reference-unreadable": "A file of the reference is a link or folder, too large, or not UTF-8.",
        "reference-definition": "benchmark.toml is not TOML, or what it says contradicts itself.",
        "reference-malformed": "A table of the reference is not a regular CSV file.",
        "reference-header": "A table of the reference has other columns than it must have.",
        "reference-value": "A cell of the reference holds what is not allowed there.",
        "reference-scenario": "A trial names a scenario that is unknown or belongs to another property.",
        "reference-duplicate": "A trial is listed twice.",
        "reference-unknown-trial": "Human data name a trial that no trial list has.",
        "reference-yes-count": "More people said YES to a trial than judged it.",
        "reference-repeated-response": "A person judged a trial twice.",
        "reference-aggregate": "The counts of human_trials.csv are not those of the single responses.",
        "reference-manifest": "manifest.json cannot be read, or contradicts itself.",
        "reference-seal": "A file of the reference is not the one that manifest.json sealed.",
    },
)

# References that depart from what their definition expects.
_define(
    Severity.WARNING,
    {
        "reference-trial-count": "A property or scenario does not have as many trials as it should.",
        "reference-incomplete-pair": "A pair does not have two trials.",
        "reference-split-pair": "The trials of a pair are in different scenarios.",
        "reference-equal-labels": "Both trials of a pair end the same way.",
        "reference-copies": "The trials of a pair are not copy 0 and copy 1.",
        "reference-participant-id": "A participant's name is not opaque.",
        "reference-kind": "The manifest's kind contradicts the trial ids.",
        "reference-stray-file": "A file lies in the reference that is no part of it.",
    },
)

# Facts about a reference that a reader should know.
_define(
    Severity.NOTE,
    {
        "reference-no-pairs": "The trials of a property come without pairs.",
        "reference-imbalance": "YES and NO are not equally frequent.",
        "reference-unrated": "Nobody judged some of the trials.",
        "reference-both-members": "People saw both trials of a pair.",
    },
)

# What importing official files finds in them.
_define(
    Severity.WARNING,
    {
        "import-unmatched": "A name in an official file fits no trial; its row is left out.",
        "import-ambiguous": "A name in an official file fits several trials; its row is left out.",
        "import-repeated": "An official file judges the same trial twice; neither row is used.",
        "import-scenario": "An official file of one scenario judges a trial of another; its row is left out.",
        "import-count": "Human accuracy times the number of people is not whole; the row is left out.",
        "import-version": "An official file is not the version that its recipe was written for.",
    },
)
_define(
    Severity.NOTE,
    {
        "import-unrated": "People did not judge some trials; they stay, without human data.",
        "import-accuracy": "Two official files give a different human accuracy for the same trials.",
    },
)


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
