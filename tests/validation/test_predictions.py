"""From rows to a table, or to what is wrong with them."""

import csv
import dataclasses
import io
import math
from decimal import Decimal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from builders import build_reference
from leaderboard.reference import Reference
from leaderboard.validation.suggestions import Suggestions
from raw_submissions import judge_predictions_file, predictions_csv, spread_probabilities

REFERENCE = build_reference()
LINES = predictions_csv(REFERENCE).splitlines()


def judge(lines: list[str]) -> list[tuple[str, int | None, str]]:
    problems = judge_predictions_file("\n".join(lines), REFERENCE).problems
    return [(problem.code, problem.line, problem.message) for problem in problems]


def with_status(statuses: dict[int, tuple[str, str]]) -> list[str]:
    """The valid rows with a status column; some rows (from 0) with another probability and status."""
    given = {row: (str(p), "") for row, p in enumerate(spread_probabilities(REFERENCE))} | statuses
    rows = [f'"{i}",{given[row][0]},{given[row][1]}' for row, i in enumerate(REFERENCE.trial_ids)]
    return ["trial_id,probability,status", *rows]


def test_whole_scenarios_may_be_left_out() -> None:
    """What is not covered is neither answered nor wrong."""
    lines = [line for line in LINES if "alpha_two" not in line]
    submission = judge_predictions_file("\n".join(lines), REFERENCE).submission
    assert submission is not None
    assert (submission.covered == ~REFERENCE.in_scenario("alpha_two")).all()
    assert (submission.answered == submission.covered).all()
    assert (submission.probabilities[~submission.covered] == 0.5).all()


def test_within_a_scenario_every_trial_is_needed() -> None:
    """Each begun scenario says how many are missing, and the first of them."""
    lines = [line for line in LINES if "alpha_two" not in line and "/0002" not in line]
    assert judge(lines) == [
        (
            "missing-trials",
            None,
            (
                f"2 of the 8 trials of {scenario} are missing: "
                f"{scenario}-copy0/set=a,b/0002, {scenario}-copy1/set=a,b/0002"
            ),
        )
        for scenario in ("alpha_one", "beta_one")
    ]


def test_long_lists_of_missing_trials_are_cut() -> None:
    """Three are named and the rest counted."""
    assert judge(LINES[:18])[0][2].endswith(" beta_one-copy1/set=a,b/0001 and 4 more")


@pytest.mark.parametrize("status", ["refused", "unparsable", "error"])
def test_a_trial_may_go_unanswered_if_the_status_says_why(status: str) -> None:
    """It is covered and not answered, and counts 0.5 where a number is needed."""
    submission = judge_predictions_file("\n".join(with_status({3: ("", status)})), REFERENCE).submission
    assert submission is not None
    assert submission.covered.all()
    assert submission.answered.sum() == 23
    assert (submission.answered[3], submission.probabilities[3]) == (False, 0.5)


@pytest.mark.parametrize(
    ("probability", "status", "code", "message"),
    [
        ("", "", "probability-missing", "the probability is empty"),
        ("", "answered", "probability-missing", "the probability is empty though the status is answered"),
        ("0.5", "refused", "contradicting-status", "status refused stands beside the probability '0.5'"),
        ("0.5", "Answered", "unknown-status", "status 'Answered' is unknown"),
        ("", "skipped", "unknown-status", "status 'skipped' is unknown"),
    ],
)
def test_status_and_probability_must_agree(probability: str, status: str, code: str, message: str) -> None:
    """A row that contradicts itself is refused with its line."""
    assert judge(with_status({3: (probability, status)})) == [(code, 5, message)]


def test_a_row_with_an_unknown_status_is_judged_to_its_end() -> None:
    """The probability beside it is judged in the same run; none is missed where the status may say why."""
    assert judge(with_status({3: ("1.5", "skipped"), 4: ("", "skipped"), 5: ("0.5", "skipped")})) == [
        ("unknown-status", 5, "status 'skipped' is unknown"),
        ("probability-out-of-range", 5, "probability '1.5' is above 1"),
        ("unknown-status", 6, "status 'skipped' is unknown"),
        ("unknown-status", 7, "status 'skipped' is unknown"),
    ]


def test_a_repeated_trial_names_both_lines_and_values() -> None:
    """Which of the two counts is for the participant to say."""
    assert judge([*LINES, f'"{REFERENCE.trial_ids[0]}",0.9']) == [
        (
            "duplicate-trial",
            26,
            "trial 'alpha_one-copy0/set=a,b/0000' is on line 2 already ('0.0213' there, '0.9' here)",
        )
    ]


def test_ids_are_compared_as_text() -> None:
    """Leading zeros matter: 0001 and 1 are different ids."""
    assert ("unknown-trial", 3, "'alpha_one-copy1/set=a,b/0' is not a trial of Tiny") in judge(
        [line.replace("copy1/set=a,b/0000", "copy1/set=a,b/0") for line in LINES]
    )


def test_a_file_of_another_benchmark_is_one_problem() -> None:
    """Not one problem for each of its rows; a single unknown row is just that."""
    other = ["trial_id,probability", *(f"pilot_{n},0.5" for n in range(500))]
    assert judge(other) == [
        ("other-benchmark", 2, "none of the 500 ids is a trial of Tiny; the first is 'pilot_0'")
    ]
    assert [code for code, _, _ in judge(other[:2])] == ["unknown-trial"]


def test_missing_trials_are_not_counted_where_rows_cannot_be_read() -> None:
    """A row with broken quotes may be the one that seems to be missing."""
    assert [code for code, _, _ in judge([LINES[0], LINES[1][1:], *LINES[2:]])] == ["ragged-row"]


def test_only_the_first_unknown_ids_get_a_suggestion() -> None:
    """As many as are shown; looking for the others would take time for nothing."""
    wrong = [line.replace("_one-", "_on-").replace("_two-", "_to-") for line in LINES[2:]]
    problems = judge_predictions_file("\n".join([*LINES[:2], *wrong]), REFERENCE).problems
    hints = [problem.hint for problem in problems if problem.code == "unknown-trial"]
    assert len(hints) == 23
    assert all(hint.startswith("did you mean") for hint in hints[:20])
    assert hints[20:] == [""] * 3


def rename(reference: Reference, length: int) -> Reference:
    """The same reference with ids that are as long as ids may be."""
    ids = tuple(f"{n:03d}".ljust(length, "x") for n in range(reference.n_trials))
    return dataclasses.replace(reference, trial_ids=ids)


@pytest.mark.parametrize("length", [60, 130, 200])
def test_messages_stay_short_however_long_ids_are(length: int) -> None:
    """Missing trials are listed as far as there is room, at least one; what was written is shown in part."""
    reference = rename(REFERENCE, length)
    header, *rows = predictions_csv(reference).splitlines()
    odd = "\U0001f600" * 90
    content = "\n".join([header, *rows[4:], rows[4].replace(",0", f",{odd}"), f"{odd},{odd}", f'"{odd}'])
    found = [p.message for p in judge_predictions_file(content, reference).problems]
    found += [p.message for p in judge_predictions_file("\n".join([header, *rows[4:]]), reference).problems]
    assert len(found) == 6
    assert max(map(len, found)) <= 400
    n_listed = {60: 3, 130: 1, 200: 1}[length]
    assert found[-1].count("x,") + 1 == n_listed
    assert found[-1].endswith(f" and {4 - n_listed} more")


PIECES = [
    '"',
    ",",
    "\n",
    "\r\n",
    "0",
    "1",
    "e-1",
    "e2",
    ".",
    "-",
    " ",
    "%",
    "refused",
    "\ufeff",
    "é",
    LINES[3],
]
EDITS = st.lists(
    st.tuples(st.floats(0, 1), st.integers(0, 6), st.sampled_from(PIECES) | st.text(max_size=3)),
    min_size=1,
    max_size=3,
)


def edit(text: str, edits: list[tuple[float, int, str]]) -> str:
    for place, length, piece in edits:
        start = int(place * len(text))
        text = text[:start] + piece + text[start + length :]
    return text


def read_independently(content: bytes) -> dict[str, float | None]:
    """What Python's own parsers make of a file, without any judgement."""
    rows = csv.DictReader(io.StringIO(content.decode("utf-8-sig"), newline=""))
    return {
        row["trial_id"]: float(Decimal(row["probability"])) if row["probability"] else None for row in rows
    }


@given(st.sampled_from([LINES, with_status({3: ("", "refused")})]), EDITS)
def test_an_edited_file_is_refused_or_means_what_it_says(
    lines: list[str], edits: list[tuple[float, int, str]]
) -> None:
    """Nothing is repaired: what is accepted is what an independent reader reads, to the last bit."""
    content = edit("\n".join([*lines, ""]), edits).encode("utf-8", "surrogatepass")
    validation = judge_predictions_file(content, REFERENCE)
    submission = validation.submission
    if submission is None:
        assert any(problem.is_error for problem in validation.problems)
        return
    expected = read_independently(content)
    for index, trial_id in enumerate(REFERENCE.trial_ids):
        given_value = expected.get(trial_id)
        assert submission.covered[index] == (trial_id in expected)
        assert submission.answered[index] == (given_value is not None)
        assert submission.probabilities[index] == (0.5 if given_value is None else given_value)
    assert len(expected) == submission.covered.sum()


@given(st.permutations(range(24)), st.booleans(), st.booleans())
def test_order_line_ends_and_mark_change_nothing(order: list[int], has_mark: bool, has_crlf: bool) -> None:
    """The arrays are in the order of the reference, whatever the order and the ends of the lines."""
    header, *rows = with_status({3: ("", "error"), 7: ("1e-1", "answered")})
    mark, end = "\ufeff" * has_mark, "\r\n" if has_crlf else "\n"
    shuffled = judge_predictions_file(
        mark + end.join([header, *(rows[place] for place in order), ""]), REFERENCE
    ).submission
    plain = judge_predictions_file("\n".join([header, *rows]), REFERENCE).submission
    assert shuffled is not None
    assert plain is not None
    for name in ("probabilities", "answered", "covered"):
        assert (getattr(shuffled, name) == getattr(plain, name)).all()


def test_numbers_as_ids_are_compared_as_text() -> None:
    """0001, 1, 1.0 and 01 are four ids, of which the benchmark has one."""
    reference = dataclasses.replace(REFERENCE, trial_ids=tuple(f"{n:04d}" for n in range(24)))
    rows = predictions_csv(reference).splitlines()
    for other in ("1", "01", "1.0", "+0001", "0001.", "\uff10001", "0001 "):
        found = judge_predictions_file("\n".join(rows).replace('"0001"', f'"{other}"'), reference).problems
        assert [(p.code, p.line) for p in found] == [("unknown-trial", 3), ("missing-trials", None)]
    hint = judge_predictions_file("\n".join(rows).replace('"0001"', "1"), reference).problems[0].hint
    assert hint == "write 0001: leading zeros matter"


GARBAGE = [
    LINES[1] + "\n" + "".join(f"wrong{n},0.5\n" for n in range(300_000)),
    LINES[1] + "\n" + "x,\n" * 1_600_000,
    "".join(f"{n},9\n" for n in range(500_000)),
    LINES[1] + "\n" + f'"{LINES[2][1:40]}{"y" * 90}",0.5\n' * 33_000,
]


@pytest.mark.parametrize("garbage", GARBAGE, ids=["unknown", "repeated", "other", "long"])
def test_five_megabytes_of_garbage_cost_little(garbage: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """At most 20 suggestions are looked for, and at most two problems kept for a row within the limit."""
    asked: list[str] = []
    explain = Suggestions.explain

    def count(self: Suggestions, text: str) -> str:
        asked.append(text)
        return explain(self, text)

    monkeypatch.setattr(Suggestions, "explain", count)
    assert 4_000_000 < len(garbage) < 5_000_000
    problems = judge_predictions_file("trial_id,probability\n" + garbage, REFERENCE).problems
    assert len(asked) <= 20
    assert len(problems) <= 2 * (10_000 + 24) + 1
    assert problems[-1].code == "too-many-rows"
    assert math.fsum(len(problem.message) for problem in problems) <= 400 * len(problems)
