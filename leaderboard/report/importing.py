"""What an import made, as text."""

from collections.abc import Iterable, Sequence

from leaderboard.reference.differences import Difference
from leaderboard.reference.fetching import SourceChange
from leaderboard.reference.importing import ImportReport
from leaderboard.reference.recipes import ImportedProperty
from leaderboard.report.problems import escape_line, render_problems

MAX_EXAMPLES = 3
_CHANGES = {
    "added": "is new",
    "removed": "is gone",
    "content": "has another content",
    "validators": "has another date or ETag, and the same content",
}


def render_import(report: ImportReport) -> str:
    """Show the oddities of the official files, what they change, and what was imported of each property."""
    oddities = render_problems(report.problems, "text") if report.problems else ""
    lines = [
        *_say_properties(report),
        *_say_source_changes(report.source_changes),
        *_say_difference(report.difference),
        _say_outcome(report),
    ]
    return oddities + "".join(f"{line}\n" for line in lines)


def _say_properties(report: ImportReport) -> Iterable[str]:
    if not report.properties:
        return
    width = max(len(p.name) for p in report.properties)
    n_trials = sum(p.n_trials for p in report.properties)
    n_rated = sum(p.n_rated for p in report.properties)
    yield f"{report.title}: {n_trials:,} trials, {n_rated:,} of them judged by people"
    for p in report.properties:
        yield f"  {p.name:<{width}}  {_describe(p)}"


def _describe(property_: ImportedProperty) -> str:
    trials = f"{property_.n_trials:4} trials, {property_.n_rated:4} judged"
    if property_.human_accuracy is None:
        return trials
    return f"{trials}, human accuracy {property_.human_accuracy:.6f}"


def _say_difference(difference: Difference | None) -> Iterable[str]:
    if not difference:
        return
    yield "the official reference that is there differs:"
    yield from _say_trials("trials are new", difference.added)
    yield from _say_trials("trials are gone", difference.removed)
    yield from _say_trials("trials end otherwise", difference.relabelled)
    yield from _say_trials("trials were judged otherwise", difference.rated_otherwise)
    yield f"  files: {', '.join(difference.files)}"


def _say_source_changes(changes: Sequence[SourceChange]) -> Iterable[str]:
    if changes:
        yield "the official files are not those that were fetched before:"
    for change in changes:
        source = change.after or change.before
        if source is not None:
            name = escape_line(source.member or source.url)
            yield f"  {name}: {_CHANGES[change.kind]}{_say_checksums(change)}"


def _say_checksums(change: SourceChange) -> str:
    if change.kind != "content" or change.before is None or change.after is None:
        return ""
    return f", sha256 {change.before.sha256} is now {change.after.sha256}"


def _say_trials(what: str, trial_ids: Sequence[str]) -> Iterable[str]:
    if trial_ids:
        more = ", ..." if len(trial_ids) > MAX_EXAMPLES else ""
        yield f"  {len(trial_ids):,} {what}: {', '.join(trial_ids[:MAX_EXAMPLES])}{more}"


def _say_outcome(report: ImportReport) -> str:
    if report.manifest is not None:
        return f"sealed as {report.manifest.kind} in {report.root}, digest {report.manifest.digest}"
    if not report.properties:
        return "nothing was written: the files cannot be made a reference"
    if report.is_changed:
        return "nothing was written; if the change is meant, add --accept-change"
    return f"nothing to write: {report.root} has this reference already"
