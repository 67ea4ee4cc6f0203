"""The account of a conversion, as a maintainer reads it."""

from dataclasses import replace

from leaderboard.converting.conversion import (
    AmbiguousAnswer,
    Conversion,
    MatchedAnswer,
    OmittedScenario,
    Prediction,
    RepeatedTrial,
)
from leaderboard.converting.log import Answer
from leaderboard.report.conversion import render_conversion

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
)


def answer(line: int, name: str = "ramp_0001", scenario: str = "rollslide", *doubts: str) -> Answer:
    return Answer("logs/results.csv", line, name, scenario, "0.5", outcome=True, doubts=doubts)


def test_clean_run_takes_one_line() -> None:
    """Where nothing is odd the counts are all there is to say."""
    assert render_conversion(CLEAN) == (
        "cswm-all-a: 2 rows give 2 predictions, for 1 of the 1 scenarios of Physion\n"
    )


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
        "    rows whose numbers do not fit together: 1 (rollslide 1)\n"
        "      results.csv:3: ramp_0002: odd; odder\n"
        "    trials with several answers that are equal, used once: 1\n"
        "      ramp_0001: results.csv:2, results.csv:22\n"
        "    scenarios that Physion does not know, so that only trials count: set_7\n"
    )


def test_names_from_logs_cannot_control_the_terminal() -> None:
    """A name with control characters is shown escaped."""
    text = render_conversion(replace(CLEAN, unmatched=(answer(5, "a\x1b[31mb"),)))
    assert "'a\\x1b[31mb'" in text
    assert "\x1b" not in text
