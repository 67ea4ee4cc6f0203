"""Files of single answers: what they hold, with every finding about it."""

from collections.abc import Iterable, Iterator

from leaderboard.problems import Problems
from leaderboard.reference.judgements.answers import is_number, parse_answer
from leaderboard.reference.judgements.columns import find_columns, simplify
from leaderboard.reference.judgements.data import FileAccount
from leaderboard.reference.judgements.layouts import Layout, Shape
from leaderboard.reference.judgements.participants import Discretion
from leaderboard.reference.judgements.reporting import FileReport
from leaderboard.reference.judgements.sifting import Answer, Fate, Piles, sort_answers, understand_answers
from leaderboard.reference.judgements.unfolding import unfold_answers
from leaderboard.reference.source_tables import SourceTable

_CHOICES = frozenset({"choices", "buttons", "options", "buttonorder", "choiceorder"})


def parse_answers(
    table: SourceTable, layout: Layout, report: FileReport, *, is_named: bool
) -> tuple[list[Answer], FileAccount]:
    """Understand the answers of a file.

    Parameters
    ----------
    table, layout
        The file, and how to read it.
    report
        Receives every finding.
    is_named
        Whether somebody vouches for what the columns mean by having named that of the responses.
    """
    piles = sort_answers(unfold_answers(table, layout), report.matcher)
    answers = understand_answers(piles[Fate.USED], table.file, report.matcher)
    account = _count_piles(table, layout, piles)
    _report_piles(piles, account, report)
    _report_doubts(answers, piles, report)
    if not is_named:
        _check_numbers(table, layout, report.problems)
    return answers, account


def find_secrets(table: SourceTable, layout: Layout) -> Discretion:
    """Gather everything in a table that may say who somebody is."""
    columns = {*find_columns(table.header, "participant"), layout.columns.get("participant", "")} & {
        *table.header
    }
    cells = {row[column] for row in table.rows for column in columns}
    return Discretion(cells | set(layout.spread if layout.shape is Shape.TRIALS else ()))


def _count_piles(table: SourceTable, layout: Layout, piles: Piles) -> FileAccount:
    return FileAccount(
        file=table.file,
        layout=layout.shape.value,
        n_rows=sum(map(len, piles.values())),
        n_practice=len(piles[Fate.PRACTICE]),
        n_empty=len(piles[Fate.EMPTY]),
        n_unmatched=len(piles[Fate.UNMATCHED]),
        n_ambiguous=len(piles[Fate.AMBIGUOUS]),
        n_unclear=len(piles[Fate.UNCLEAR]),
        n_anonymous=len(piles[Fate.ANONYMOUS]),
        n_used=len(piles[Fate.USED]),
    )


def _report_piles(piles: Piles, account: FileAccount, report: FileReport) -> None:
    report.report_left_out("import-practice", piles[Fate.PRACTICE], "to practice trials")
    report.report_left_out("import-non-answer", piles[Fate.EMPTY], "that are empty or about no trial")
    report.report_left_out("import-no-participant", piles[Fate.ANONYMOUS], "without participant")
    report.report_matches(account.n_named, piles[Fate.UNMATCHED], piles[Fate.AMBIGUOUS])
    unclear = piles[Fate.UNCLEAR]
    report.report_unclear(unclear, [a.correct or "" if a.response is None else a.response for a in unclear])


def _report_doubts(answers: list[Answer], piles: Piles, report: FileReport) -> None:
    told = [
        (answer.trial_id, answer.line, answer.label)
        for answer, raw in zip(answers, piles[Fate.USED], strict=True)
        if raw.label is not None and parse_answer(raw.label) is not None
    ]
    report.report_labels(told, matters=any(answer.is_derived for answer in answers))
    report.report_contradictions(answers)


def _check_numbers(table: SourceTable, layout: Layout, problems: Problems) -> None:
    """Ask what 1 means where it might be something else than YES."""
    if layout.shape is Shape.ANSWERS:
        response = layout.columns.get("response")
        if response is not None and "correct" not in layout.columns:
            _check_buttons(table, response, problems)
    elif not any(_is_word(row[column]) for row in table.rows for column in layout.spread):
        message = "holds 0 and 1 (or False and True), which are taken as NO and YES"
        hint = "if they mean wrong and right, give one row for each answer, with a column called correct"
        problems.add("import-assumed-yes", message, table.file, hint=hint)


def _check_buttons(table: SourceTable, response: str, problems: Problems) -> None:
    """Refuse numbers where a column lists the buttons: 1 may be YES, or the second button."""
    said = [row[response] for row in table.rows if parse_answer(row[response]) is not None]
    if not all(map(is_number, said)):
        return
    for column in table.header:
        if simplify(column) in _CHOICES and _list_buttons(row[column] for row in table.rows):
            message = f"{column} lists the buttons, so 1 in {response} may be YES or the number of a button"
            hint = f"--columns response={response} takes it as YES"
            problems.add("import-answer-meaning", message, table.file, hint=hint)


def _list_buttons(cells: Iterable[str]) -> bool:
    return any({True, False} <= set(_read_words(cell)) for cell in cells)


def _read_words(cell: str) -> Iterator[bool | None]:
    return (parse_answer(word) for word in cell.split(",") if not is_number(word.strip("[]'\" ")))


def _is_word(cell: str) -> bool:
    """Tell whether a cell is YES or NO in words, which say more than numbers or truth values."""
    return parse_answer(cell) is not None and not is_number(cell) and cell.strip().casefold() not in _TRUTHS


_TRUTHS = frozenset({"true", "false", "t", "f"})
