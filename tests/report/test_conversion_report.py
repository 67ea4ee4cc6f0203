"""The account of a conversion, as a maintainer reads it."""

from dataclasses import replace

from leaderboard.converting.conversion import Conversion, OmittedScenario, RepeatedTrial
from leaderboard.converting.log import Answer
from leaderboard.converting.matching import AmbiguousAnswer, MatchedAnswer
from leaderboard.converting.merging import Prediction
from leaderboard.converting.traps import Traps
from leaderboard.problems import Problem
from leaderboard.report.conversion import conversion_data, render_conversion
from leaderboard.submission import Status

CLEAN = Conversion(
    name="cswm-all-a",
    benchmark="Physion",
    n_rows=2,
    predictions=(Prediction("ramp_0001", "0.5"), Prediction("ramp_0002", "0.25")),
    scenarios=("roll",),
    omitted=(),
    unmatched=(),
    ambiguous=(),
    misplaced=(),
    repeated=(),
    contradicting=(),
    doubtful=(),
    unknown_scenarios=(),
    traps=Traps(
        n_trials=2,
        n_matched=2,
        statuses=((Status.ANSWERED, 2),),
        n_ties=1,
        repeats=((1, 2),),
        n_answers=2,
    ),
)
SIGNS = (
    "  before you send it:\n"
    "    trials: 2 of 2 matched, 0 missing, 0 duplicated; rows ambiguous: 0\n"
    "    statuses: answered 2\n"
    "    YES: 0 of 2 (0.0 %) of the answered trials, and exactly one half: 1\n"
    "    pairs with the same answer to both members: none of 0\n"
)


def answer(line: int, name: str = "ramp_0001", scenario: str = "rollslide", *doubts: str) -> Answer:
    return Answer("logs/results.csv", line, name, scenario, "0.5", outcome=True, doubts=doubts)


def test_clean_run_ends_with_the_signs_of_mistakes() -> None:
    """Where nothing is odd the counts are all there is to say; those that give away mistakes always are."""
    assert render_conversion(CLEAN) == (
        f"cswm-all-a: 2 rows give 2 predictions, for 1 of the 1 scenarios of Physion\n{SIGNS}"
    )


def test_repeats_reader_and_warnings_are_told() -> None:
    """How often trials were asked, which reader read the answers, and what validation warns of."""
    traps = replace(CLEAN.traps, repeats=((4, 1), (5, 1)), n_answers=9, n_unanswered=2)
    text = render_conversion(
        replace(CLEAN, traps=traps, reader=7),
        [Problem("equal-to-labels", "the probabilities equal the labels", "p.csv", hint="did it see them?")],
    )
    assert text.endswith(
        "    repeats, of which the mean is written: 1 trials 4 times, 1 trials 5 times; "
        "2 of 9 answers say neither YES nor NO\n"
        "    texts were read by version 7 of the reader: submit with --answer-reader 7\n"
        "  p.csv: warning: equal-to-labels: the probabilities equal the labels\n"
        "      did it see them?\n"
    )


def test_account_for_programs_has_every_count() -> None:
    """The data hold what the text tells, with the version of the reader."""
    data = conversion_data(replace(CLEAN, reader=7), [])
    assert (data["run"], data["answer_reader"], data["statuses"]) == ("cswm-all-a", 7, {"answered": 2})
    assert data["validation"] == {"valid": True, "errors": [], "warnings": []}


def test_places_and_scenarios_that_a_log_lacks_are_left_out() -> None:
    """A sample of a log without lines has its number; where no scenario is named there is none to count."""
    sample = replace(answer(4, "other", ""), file="logs/run.json", unit="sample")
    text = render_conversion(replace(CLEAN, unmatched=(sample,)))
    assert "rows about trials that Physion does not have: 1\n      run.json, sample 4: 'other'\n" in text


def test_every_oddity_is_told_with_examples() -> None:
    """Each kind has its count, where it occurs, why it is left out or kept, and lines to look at."""
    odd = replace(
        CLEAN,
        n_rows=20,
        omitted=(OmittedScenario("drape", 72, 150), OmittedScenario("drop", 0, 150)),
        unmatched=tuple(answer(10 + k, f"other_{k}", "cloth" if k else "rollslide") for k in range(5)),
        ambiguous=(AmbiguousAnswer(answer(20, "a_img"), ("a", "a-redyellow")),),
        misplaced=(MatchedAnswer(answer(21, "drop_0001"), "drop_0001", "drop"),),
        repeated=(
            RepeatedTrial("ramp_0001", (answer(2), answer(22))),
            RepeatedTrial("drape_0007", (answer(23), replace(answer(24), probability="0.7"))),
        ),
        contradicting=(MatchedAnswer(answer(2), "ramp_0001", "roll"),),
        doubtful=(MatchedAnswer(answer(3, "ramp_0002", "rollslide", "odd", "odder"), "ramp_0002", "roll"),),
        unknown_scenarios=("set_7",),
    )
    assert render_conversion(odd) == (
        "cswm-all-a: 20 rows give 2 predictions, for 1 of the 3 scenarios of Physion\n"
        "  left out:\n"
        "    rows about trials that Physion does not have: 5 (cloth 4, rollslide 1)\n"
        "      results.csv:10: 'other_0'\n"
        "      results.csv:11: 'other_1'\n"
        "      results.csv:12: 'other_2'\n"
        "      and 2 more\n"
        "    rows whose name fits several trials: 1 (rollslide 1)\n"
        "      results.csv:20: 'a_img' fits a and a-redyellow\n"
        "    rows with their trial in another scenario than Physion has it in: 1 (rollslide 1)\n"
        "      results.csv:21: drop_0001 belongs to drop\n"
        "    trials with several answers that differ, none of which is used: 1\n"
        "      drape_0007: results.csv:23, results.csv:24\n"
        "    scenarios that the run does not cover, since they are given whole or not at all: 2\n"
        "      drape: 72 of 150 trials are answered\n"
        "      drop: 0 of 150 trials are answered\n"
        "  kept, but worth a look:\n"
        "    trials that end differently in the log than by their label: 1 of 2 (roll 1)\n"
        "      results.csv:2: ramp_0001 is YES in the log, its label is NO\n"
        "    rows that do not agree with themselves: 1 (rollslide 1)\n"
        "      results.csv:3: ramp_0002: odd; odder\n"
        "    trials with several answers that are equal, used once: 1\n"
        "      ramp_0001: results.csv:2, results.csv:22\n"
        "    scenarios that Physion does not know, so that only trials count: set_7\n"
        f"{SIGNS}"
    )


def test_names_from_logs_cannot_control_the_terminal() -> None:
    """A name with control characters, of a trial or of a scenario, is shown escaped."""
    hostile = answer(5, "a\x1b[31mb", "\x1b[2J")
    text = render_conversion(replace(CLEAN, unmatched=(hostile,), unknown_scenarios=("\x1b[2J", "\ud800")))
    assert "'a\\x1b[31mb'" in text
    assert "does not have: 1 ('\\x1b[2J' 1)" in text
    assert "so that only trials count: '\\x1b[2J', '\\ud800'" in text
    assert "\x1b" not in text
