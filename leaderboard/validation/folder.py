"""Which files a submission consists of."""

from leaderboard.ids import SLUG_RULE, find_nearest, is_slug
from leaderboard.instance import PREDICTIONS_FILE, RESULT_FILE, SUBMISSION_FILE
from leaderboard.problems import Problems
from leaderboard.submission import SIZE_LIMITS, RawFile, RawSubmission
from leaderboard.validation.quoting import quote_briefly

REQUIRED = (SUBMISSION_FILE, PREDICTIONS_FILE)
ALLOWED = (*REQUIRED, RESULT_FILE)


def judge_folder(raw: RawSubmission, problems: Problems) -> None:
    """Judge the folder's name and its entries: what is missing, too much, too large or not a plain file."""
    if raw.slug is not None:
        _judge_slug(raw, problems)
        for name in REQUIRED:
            if raw.find(name) is None:
                _report_missing(raw, name, problems)
    for file in raw.files:
        if raw.slug is not None and file.name not in ALLOWED:
            _report_unexpected(raw, file, problems)
        elif file.kind != "file":
            _report_kind(raw, file, problems)
        elif file.content is None:
            _report_size(raw, file, problems)


def _judge_slug(raw: RawSubmission, problems: Problems) -> None:
    if raw.slug is not None and not is_slug(raw.slug):
        message = f"{quote_briefly(raw.slug)} cannot name a submission"
        problems.add(
            "slug-malformed", message, _shown(raw.location), hint=f"name the folder with {SLUG_RULE}"
        )


def _report_missing(raw: RawSubmission, name: str, problems: Problems) -> None:
    hint = "a submission is a folder with submission.toml and predictions.csv"
    near = find_nearest(name, (file.name for file in raw.files if file.name not in ALLOWED))
    if near:
        hint = f"is it {quote_briefly(near)}? Rename it to {name}"
    problems.add("file-missing", f"there is no {name}", raw.location, hint=hint)


def _report_unexpected(raw: RawSubmission, file: RawFile, problems: Problems) -> None:
    near = find_nearest(file.name, ALLOWED)
    hint = f"did you mean {near}?" if near else f"keep only {', '.join(ALLOWED)} here"
    message = f"{quote_briefly(file.name)} does not belong in a submission"
    problems.add("unexpected-file", message, _shown(raw.path_of(file.name)), hint=hint)


def _report_kind(raw: RawSubmission, file: RawFile, problems: Problems) -> None:
    what = {"symlink": "a symbolic link", "folder": "a folder"}.get(file.kind, "a device, pipe or socket")
    message = f"is {what}, not a plain file; nothing in it was read"
    problems.add("not-a-plain-file", message, raw.path_of(file.name), hint="put the file itself in its place")


def _report_size(raw: RawSubmission, file: RawFile, problems: Problems) -> None:
    limit = SIZE_LIMITS[file.name]
    hint = {
        PREDICTIONS_FILE: "a row per trial is all that is needed: is this raw output?",
        RESULT_FILE: f"remove it, and make it with: leaderboard grade {_shown(raw.location)}",
    }.get(file.name, "shorten it")
    size = f"{file.size:,} bytes" if file.size > limit else "too large to have been fetched"
    message = f"is {size}; the limit is {limit:,}"
    problems.add("file-too-large", message, raw.path_of(file.name), hint=hint)


def _shown(path: str) -> str:
    """Show a path that may hold anything: as it is if plain, else escaped."""
    return path if path.isascii() and path.isprintable() else ascii(path)[1:-1]
