"""Whether errata say anything: trials that are there, findings that were made."""

from collections.abc import Sequence

from leaderboard.instance import ERRATA_FILE
from leaderboard.models.errata import Acceptance
from leaderboard.problems import CODES, Problem, Problems, Severity
from leaderboard.reference.cells import quote
from leaderboard.reference.checking.datasheet import Row, Section, is_accepted_by, make_row
from leaderboard.reference.data import Reference
from leaderboard.reference.definition import shown

FILE = shown(ERRATA_FILE)


def check_corrections(reference: Reference, problems: Sequence[Problem]) -> Section:
    """Report entries of errata without effect.

    Parameters
    ----------
    reference
        With the errata, and without what they drop.
    problems
        All findings about the reference's content.
    """
    return Section("Errata", (_check_drops(reference), _check_acceptances(reference, problems)))


def _check_drops(reference: Reference) -> Row:
    problems = Problems()
    for drop in reference.errata.drop:
        if drop.trial_id not in reference.dropped:
            message = f"no trial list has {quote(drop.trial_id)}, which is to be dropped"
            problems.add("reference-errata-trial", message, FILE, hint="remove the entry, or mend the id")
    n_entries = len(reference.errata.drop)
    found = f"{len(reference.dropped)} of {n_entries}" if n_entries else "none"
    expected = "all" if n_entries else ""
    return make_row("Trials to drop are there", found, expected=expected, problems=problems)


def _check_acceptances(reference: Reference, problems: Sequence[Problem]) -> Row:
    entries = reference.errata.accept
    unused = Problems()
    for entry in entries:
        if not any(is_accepted_by(problem, entry.code, entry.where) for problem in problems):
            hint = "remove the entry, or compare it with what `leaderboard reference check` prints"
            unused.add("reference-errata-unused", _say_unused(entry), FILE, hint=hint)
    found = f"{len(entries) - len(unused)} of {len(entries)}" if entries else "none"
    expected = "all" if entries else ""
    return make_row("Findings to accept are there", found, expected=expected, problems=unused)


def _say_unused(entry: Acceptance) -> str:
    code = CODES.get(entry.code)
    if code is None:
        return f"accepts {quote(entry.code)}, which is no code of a finding"
    if code.severity is Severity.ERROR:
        return f"accepts {entry.code}, but an error cannot be accepted"
    where = f" with the words {quote(entry.where)}" if entry.where else ""
    return f"accepts {entry.code}, but there is no such finding{where}"
