"""What can be wrong with a submission."""

from leaderboard.problems.catalogue import Severity

_ERRORS = {
    # Submissions that are refused.
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
    "forbidden-character": "A text in submission.toml holds a control, direction or invisible character.",
    "link-refused": "A link in submission.toml is not a plain web link.",
    "date-in-future": "The submission's date is later than tomorrow.",
    "no-track": "No track takes the submission's protocol.",
}
_WARNINGS = {
    # Submissions that are graded all the same.
    "constant-probabilities": "All probabilities are equal.",
    "equal-to-labels": "The probabilities are the labels.",
    "equal-to-human-means": "The probabilities are the shares of people who said YES.",
    "copy-of-another": "The probabilities are those of another team's submission, or nearly.",
    "swapped-copies": "Pairs are told apart, but the wrong way round more than chance would have it.",
    "beyond-track": "The model's inputs hold more than the track shows.",
}

MEANINGS = {Severity.ERROR: _ERRORS, Severity.WARNING: _WARNINGS}
