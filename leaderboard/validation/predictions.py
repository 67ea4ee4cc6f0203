"""From the rows of ``predictions.csv`` to arrays in the reference's order."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from leaderboard.problems import Problems
from leaderboard.reference import Reference
from leaderboard.submission import Status
from leaderboard.validation.probability import Fault, parse_probability
from leaderboard.validation.quoting import quote_briefly
from leaderboard.validation.table import Row, parse_rows
from leaderboard.validation.text import decode_text

if TYPE_CHECKING:
    from leaderboard.validation.suggestions import Suggestions

MAX_SUGGESTIONS = 20
MAX_LISTED = 3
_MAX_LIST_LENGTH = 250

UNANSWERED = tuple(status.value for status in Status if status is not Status.ANSWERED)


@dataclass(frozen=True)
class Predictions:
    """A predictions file as arrays; see ``Submission`` for their meaning."""

    sha256: str
    probabilities: NDArray[np.float64]
    answered: NDArray[np.bool_]
    covered: NDArray[np.bool_]


def judge_predictions(
    content: bytes, sha256: str, reference: Reference, file: str, problems: Problems
) -> Predictions | None:
    """Judge a predictions file; None, and problems in the order of lines, if it is not valid.

    Every row's id and probability is judged, whatever is wrong with others; which trials are missing is
    said only of a file whose rows can all be read. Rows of trials that the reference dropped are as good as
    any, and do not count: submissions that were made before stay valid.
    """
    text = decode_text(content, file, problems)
    if text is None:
        return None
    found = Problems()
    rows = parse_rows(text, reference.trial_index, file, found)
    is_regular = not found
    known = _judge_ids(rows, reference, file, found)
    predictions = _empty_predictions(sha256, reference)
    for row in rows:
        value = _judge_value(row, file, found)
        index = known.get(row.trial_id)
        if index is not None and value is not None:
            predictions.probabilities[index], predictions.answered[index] = value
    predictions.covered[list(known.values())] = True
    if is_regular and rows and known:
        _judge_coverage(predictions.covered, reference, file, found)
    problems.extend_by_line(found)
    return None if found else predictions


def _empty_predictions(sha256: str, reference: Reference) -> Predictions:
    nothing = np.zeros(reference.n_trials, bool)
    return Predictions(sha256, np.full(reference.n_trials, 0.5), nothing.copy(), nothing.copy())


def _judge_ids(rows: Sequence[Row], reference: Reference, file: str, problems: Problems) -> dict[str, int]:
    """Map each known id to its position; report unknown and repeated ones, and leave out dropped ones."""
    first: dict[str, Row] = {}
    known: dict[str, int] = {}
    unknown: list[Row] = []
    for row in rows:
        earlier = first.setdefault(row.trial_id, row)
        if earlier is not row:
            _report_duplicate(row, earlier, file, problems)
        elif row.trial_id in reference.trial_index:
            known[row.trial_id] = reference.trial_index[row.trial_id]
        elif row.trial_id not in reference.dropped:
            unknown.append(row)
    if rows and not known and not unknown:
        _report_all_dropped(rows[0], reference, file, problems)
    elif len(unknown) > 1 and not known:
        _report_other_benchmark(unknown, reference, file, problems)
    elif unknown:
        _report_unknown(unknown, reference, file, problems)
    return known


def _report_duplicate(row: Row, earlier: Row, file: str, problems: Problems) -> None:
    values = f"{quote_briefly(earlier.probability)} there, {quote_briefly(row.probability)} here"
    message = f"trial {quote_briefly(row.trial_id)} is on line {earlier.line} already ({values})"
    problems.add("duplicate-trial", message, file, line=row.line, hint="keep one of the two rows")


def _report_all_dropped(first: Row, reference: Reference, file: str, problems: Problems) -> None:
    message = f"every trial of the file was dropped from {reference.benchmark.title}"
    hint = f"the reason for {first.trial_id}: {reference.dropped[first.trial_id]}"
    problems.add("other-benchmark", message, file, line=first.line, hint=hint)


def _report_other_benchmark(
    unknown: Sequence[Row], reference: Reference, file: str, problems: Problems
) -> None:
    title = reference.benchmark.title
    first = unknown[0]
    message = (
        f"none of the {len(unknown)} ids is a trial of {title}; the first is {quote_briefly(first.trial_id)}"
    )
    near = _suggest(reference).explain(first.trial_id)
    hint = near or f"ids of {title} look like {reference.trial_ids[0]}"
    problems.add("other-benchmark", message, file, line=first.line, hint=hint)


def _report_unknown(unknown: Sequence[Row], reference: Reference, file: str, problems: Problems) -> None:
    suggestions = _suggest(reference)
    otherwise = f"its ids look like {reference.trial_ids[0]}"
    for number, row in enumerate(unknown):
        given = quote_briefly(row.trial_id) if row.trial_id else "an empty id"
        message = f"{given} is not a trial of {reference.benchmark.title}"
        hint = (suggestions.explain(row.trial_id) or otherwise) if number < MAX_SUGGESTIONS else ""
        problems.add("unknown-trial", message, file, line=row.line, hint=hint)


def _suggest(reference: Reference) -> "Suggestions":
    from leaderboard.validation.suggestions import Suggestions  # only mistakes pay for it

    return Suggestions(reference.trial_ids)


def _judge_value(row: Row, file: str, problems: Problems) -> tuple[float, bool] | None:
    """Return probability and whether it was given; None, and a problem, if the row contradicts itself."""
    if row.status not in ("", Status.ANSWERED, *UNANSWERED):
        hint = f"write {', '.join((Status.ANSWERED.value, *UNANSWERED))}, or leave it empty"
        message = f"status {quote_briefly(row.status)} is unknown"
        problems.add("unknown-status", message, file, line=row.line, hint=hint)
        if row.probability:
            _judge_probability(row, file, problems)
        return None
    if row.status in UNANSWERED:
        if row.probability:
            message = f"status {row.status} stands beside the probability {quote_briefly(row.probability)}"
            hint = "leave the probability empty, or the status"
            problems.add("contradicting-status", message, file, line=row.line, hint=hint)
            return None
        return 0.5, False
    if not row.probability:
        message = f"the probability is empty{' though the status is answered' if row.status else ''}"
        hint = f"give a number, or say why there is none in the column status: {', '.join(UNANSWERED)}"
        problems.add("probability-missing", message, file, line=row.line, hint=hint)
        return None
    return _judge_probability(row, file, problems)


def _judge_probability(row: Row, file: str, problems: Problems) -> tuple[float, bool] | None:
    value = parse_probability(row.probability)
    if isinstance(value, Fault):
        message = f"probability {quote_briefly(row.probability)} {value.what}"
        problems.add(value.code, message, file, line=row.line, hint=value.hint)
        return None
    return value, True


def _judge_coverage(covered: NDArray[np.bool_], reference: Reference, file: str, problems: Problems) -> None:
    """Report the trials that are missing from scenarios that were begun."""
    for scenario in reference.benchmark.scenarios:
        mask = reference.in_scenario(scenario.id)
        missing = np.flatnonzero(mask & ~covered)
        if missing.size and missing.size < mask.sum():
            listed = _list_briefly([reference.trial_ids[index] for index in missing])
            message = f"{missing.size} of the {mask.sum()} trials of {scenario.id} are missing: {listed}"
            problems.add("missing-trials", message, file, hint=_hint_missing(missing, mask, reference))


def _list_briefly(trial_ids: Sequence[str]) -> str:
    """List the first ids, as far as a message has room, and count the others."""
    shown = [trial_ids[0]]
    for trial_id in trial_ids[1:MAX_LISTED]:
        if len(", ".join((*shown, trial_id))) > _MAX_LIST_LENGTH:
            break
        shown.append(trial_id)
    n_others = len(trial_ids) - len(shown)
    return f"{', '.join(shown)}{f' and {n_others} more' if n_others else ''}"


def _hint_missing(missing: NDArray[np.intp], mask: NDArray[np.bool_], reference: Reference) -> str:
    copies = set(reference.copies[missing].tolist())
    if len(copies) == 1 and missing.size == (mask & (reference.copies == copies.copy().pop())).sum():
        return f"every copy {copies.pop()} is missing: give both members of each pair"
    return "give every trial of a scenario, or leave the scenario out"
