"""From the names that other tools give trials to trial ids, in files that are sound but for their names."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from leaderboard.problems import Problems
from leaderboard.reference import Reference
from leaderboard.trial_names import Resolved, TrialNames
from leaderboard.validation.table import Row, parse_rows
from leaderboard.validation.text import BOM, decode_text


@dataclass(frozen=True)
class TranslatedName:
    """A name that stood in a predictions file, and the trial that it means."""

    name: str
    trial_id: str


def translate_names(content: bytes, reference: Reference) -> tuple[bytes, tuple[TranslatedName, ...]]:
    """Write trial ids in place of other names in a predictions file, where a name means exactly one trial.

    Everything else keeps its bytes and lines. A file that is no regular table is not touched, and neither
    are names that fit several trials or none: all of that is for validation to explain.

    Returns
    -------
    tuple
        The content, and what was translated, in the order of lines.
    """
    text, rows = _parse_strictly(content, reference)
    found = list(_resolve(rows, reference))
    if not found:
        return content, ()
    lines = text.split("\n")
    for row, trial_id in found:
        lines[row.line - 1] = _replace_id(lines[row.line - 1], row.trial_id, trial_id)
    mark = BOM if content.startswith(BOM) else b""
    names = tuple(TranslatedName(row.trial_id, trial_id) for row, trial_id in found)
    return mark + "\n".join(lines).encode(), names


def _parse_strictly(content: bytes, reference: Reference) -> tuple[str, list[Row]]:
    """Parse a file as validation does; a single fault in it, and there are no rows."""
    faults = Problems()
    text = decode_text(content, "", faults)
    if text is None:
        return "", []
    rows = parse_rows(text, reference.trial_index, "", faults)
    return text, ([] if faults else rows)


def _resolve(rows: Sequence[Row], reference: Reference) -> Iterator[tuple[Row, str]]:
    known = (*reference.trial_ids, *reference.dropped)  # a dropped trial is not to be taken for another
    ids = frozenset(known)
    others = [row for row in rows if row.trial_id not in ids]
    if others:
        names = TrialNames(known)
        for row in others:
            found = names.resolve(row.trial_id)
            if isinstance(found, Resolved):
                yield row, found.trial_id


def _replace_id(line: str, name: str, trial_id: str) -> str:
    r"""Replace the first cell of a line of CSV, and nothing after it.

    >>> _replace_id('"a,b.mp4","0.5"\r', "a,b.mp4", "a,b"), _replace_id("a.mp4,0.5", "a.mp4", "a")
    ('"a,b","0.5"\r', 'a,0.5')
    """
    doubled = name.replace('"', '""')
    written = f'"{doubled}"' if line.startswith('"') else name
    cell = f'"{trial_id}"' if "," in trial_id else trial_id
    return cell + line.removeprefix(written)
