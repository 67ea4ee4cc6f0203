"""Where rules begin and end: the cases that mutants of the validator survived without."""

import dataclasses
import datetime as dt

import numpy as np
import pytest

from builders import build_benchmark, build_metadata, build_reference, build_submission
from leaderboard.problems import Problem, Problems
from leaderboard.reference import Reference
from leaderboard.reference.dropping import drop_trials
from leaderboard.submission import RawFile
from leaderboard.submission import RawSubmission as Raw
from leaderboard.validation.folder import judge_folder
from leaderboard.validation.metadata import judge_metadata
from leaderboard.validation.predictions import judge_predictions
from leaderboard.validation.probability import Fault, parse_probability
from leaderboard.validation.quoting import quote_briefly
from leaderboard.validation.suggestions import Suggestions
from leaderboard.validation.text import decode_text
from leaderboard.validation.warnings import find_suspicions, judge_inputs
from raw_submissions import SUBMISSION_TOML, TODAY, predictions_csv

REFERENCE = build_reference(16)
PERCENT = "a percentage or a logit? Divide by 100, or apply the logistic function"
LOGIT = "a logit? Apply the logistic function"
PLAIN = "write a plain number between 0 and 1, such as 0.5"


def faults_of_text(content: bytes) -> list[tuple[str, int | None]]:
    problems = Problems()
    assert decode_text(content, "f", problems) is None
    return [(problem.code, problem.line) for problem in problems]


def judge_table(content: str, reference: Reference = REFERENCE) -> list[Problem]:
    problems = Problems()
    judge_predictions(content.encode(), "0" * 64, reference, "f.csv", problems)
    return list(problems)


def judge_toml(toml: str) -> list[Problem]:
    problems = Problems()
    judge_metadata(toml.encode(), build_benchmark(), "f.toml", TODAY, problems)
    return list(problems)


def test_four_hundred_characters_are_a_number() -> None:
    """One more is none."""
    assert parse_probability("0." + "5" * 398) == pytest.approx(5 / 9)
    assert isinstance(parse_probability("0." + "5" * 399), Fault)


@pytest.mark.parametrize(
    ("text", "what", "hint"),
    [
        ("1.000001", "is above 1", "if that comes from rounding, write 1"),
        ("-0.000001", "is below 0", "if that comes from rounding, write 0"),
        ("1.00001", "is above 1", PERCENT),
        ("-0.00001", "is below 0", LOGIT),
        ("100", "is above 1", PERCENT),
        ("100.5", "is above 1", PLAIN),
        ("-3", "is below 0", LOGIT),
        ("1e999", "is too large for a number", PLAIN),
        ("-1e999", "is too far below 0 for a number", PLAIN),
        ("1.00000000000000000001", "is above 1", "if that comes from rounding, write 1"),
    ],
)
def test_advice_fits_the_distance(text: str, what: str, hint: str) -> None:
    """A hair, somewhat and far outside of 0 to 1 are three different mistakes, on either side."""
    fault = parse_probability(text)
    assert isinstance(fault, Fault)
    assert (fault.what, fault.hint) == (what, hint)


@pytest.mark.parametrize(
    ("content", "code", "line"),
    [
        (b"a\0\nb\0\n", "nul-byte", 1),
        (b"\n\nb\0\n", "nul-byte", 3),
        (b"\xe9\n", "not-utf8", 1),
        (b"\n\n\xe9\n", "not-utf8", 3),
        (b"a\rb\nc\rd\n", "line-ends", 1),
        (b"\na\rb\n\nc\rd\n", "line-ends", 2),
        (b"\r\n\r\na\rb\n", "line-ends", 3),
    ],
)
def test_the_first_odd_byte_is_located(content: bytes, code: str, line: int) -> None:
    """Lines count from 1, whichever way they end and however many odd bytes follow."""
    assert faults_of_text(content) == [(code, line)]


@pytest.mark.parametrize(
    ("content", "byte"), [(b"\xe9", 1), (b"ab\xe9", 3), (b"a\nb\xe9", 2), (b"\n\xe9", 1)]
)
def test_an_odd_byte_has_its_place_in_the_line(content: bytes, byte: int) -> None:
    """Bytes count from 1, on the first line as on the others."""
    problems = Problems()
    decode_text(content, "f", problems)
    assert f"byte {byte} " in f"{problems.found[0].message} "


@pytest.mark.parametrize(
    ("text", "limit", "shown"),
    [
        ("a" * 10, 10, "'aaaaaaaaaa'"),
        ("a" * 11, 10, "'aaaaa...aa'"),
        ("a" * 9 + "\t", 10, "'aaaa...a\\t'"),
        ("a" * 8 + "\t", 10, "'aaaaaaaa\\t'"),
    ],
)
def test_a_quotation_is_as_long_as_allowed(text: str, limit: int, shown: str) -> None:
    """What takes exactly the limit is shown whole; escapes count as what they are written with."""
    assert quote_briefly(text, limit) == shown


def test_problems_of_dropped_and_foreign_files_name_the_file() -> None:
    """Whoever sends several files must know which one is meant."""
    foreign = "trial_id,probability\nx/1,0.5\nx/2,0.5\n"
    assert [(p.code, p.file, p.line) for p in judge_table(foreign)] == [("other-benchmark", "f.csv", 2)]
    gone = REFERENCE.trial_ids[0]
    found = judge_table(f'trial_id,probability\n"{gone}",0.5\n', drop_trials(REFERENCE, {gone: "Empty."}))
    assert [(p.code, p.file, p.line) for p in found] == [("other-benchmark", "f.csv", 2)]


def test_one_foreign_id_is_a_slip_and_two_are_another_benchmark() -> None:
    """With no known id beside them."""
    assert [p.code for p in judge_table("trial_id,probability\nx/1,0.5\n")] == ["unknown-trial"]


def test_every_copy_is_named_only_if_every_one_is_missing() -> None:
    """Some missing copies are just missing trials."""
    header, *rows = predictions_csv(REFERENCE).splitlines(keepends=True)
    every = [row for row in rows if not row.startswith('"beta_one-copy1')]
    assert judge_table("".join([header, *every]))[0].hint == (
        "every copy 1 is missing: give both members of each pair"
    )
    some = [row for row in rows if not row.startswith('"beta_one-copy1/set=a,b/0003')]
    assert judge_table("".join([header, *some]))[0].hint == (
        "give every trial of a scenario, or leave the scenario out"
    )


@pytest.mark.parametrize(
    ("header", "hint"),
    [
        (
            ",trial_id,probability",
            "leave out the first column, which numbers the rows (in pandas: index=False)",
        ),
        (
            "Index,trial_id,probability",
            "leave out the first column, which numbers the rows (in pandas: index=False)",
        ),
    ],
)
def test_a_column_of_numbers_is_recognised(header: str, hint: str) -> None:
    """With or without its usual name."""
    found = judge_table(f"{header}\n0,x,0.5\n")
    assert [(p.code, p.hint) for p in found] == [("wrong-header", hint)]


def test_a_separator_is_none_where_commas_separate() -> None:
    """A semicolon in a header with commas is part of a name."""
    found = judge_table("trial;id,probability\nx,0.5\n")
    assert [p.code for p in found] == ["wrong-header"]


def test_a_text_of_many_dots_is_refused_before_it_is_parsed() -> None:
    """A thousand in a line are read, one more is not, and the line is named."""
    dots = "." * 1000
    with_dots = SUBMISSION_TOML.replace('"One or two sentences."', f'"{dots}"')
    assert judge_toml(with_dots) == []
    found = judge_toml(with_dots.replace(dots, f"{dots}."))
    assert [(p.code, p.file, p.line, p.message, p.hint) for p in found] == [
        ("toml-syntax", "f.toml", 6, "is nested too deeply", "sections hold plain values only")
    ]


def test_a_section_with_quotes_is_located() -> None:
    """Its faults name its line, whichever quotes stand around its name."""
    for written in ('["protocol"]', "['protocol']", "[ protocol ]"):
        toml = SUBMISSION_TOML.replace("[protocol]", written).replace('"separate"', '"other"')
        found = judge_toml(toml)
        assert [(p.code, p.line) for p in found] == [("unknown-value", 9)]


def test_a_dotted_section_is_located() -> None:
    """A section within a section is unknown where it stands."""
    found = judge_toml(SUBMISSION_TOML + "\n[model.x]\ny = 1\n")
    assert [(p.code, p.line, p.message) for p in found] == [("unknown-key", 19, "model.x is not a known key")]


def test_a_key_of_eighty_characters_is_shown_plainly() -> None:
    """A longer one is quoted and cut."""
    whole, longer = "k" * (80 - len("model.")), "k" * (81 - len("model."))
    for key, shown in ((whole, f"model.{whole} is"), (longer, "'model.kkk")):
        message = judge_toml(SUBMISSION_TOML.replace("[model]", f"[model]\n{key} = 1"))[0].message
        assert message.startswith(shown)


def test_stacked_marks_are_told_apart_from_invisible_characters() -> None:
    """Four marks on one letter are writing, five are a tower; the advice is to write fewer."""
    for n_marks, messages in ((4, []), (5, ["submission.name stacks more than 4 marks at position 6"])):
        found = judge_toml(SUBMISSION_TOML.replace('"Example"', f'"x{chr(0x336) * n_marks}"'))
        assert [p.message for p in found] == messages
        assert [p.hint for p in found] == ["write letters with at most a few marks"] * len(messages)


def test_known_keys_are_listed_with_commas() -> None:
    """Where nothing is near."""
    found = judge_toml(SUBMISSION_TOML.replace("[model]", "[model]\nqqqqqqqq = 1"))
    assert found[0].hint == "known here: family, inputs, parameters, pretraining"


def test_a_blob_that_was_not_fetched_has_no_size() -> None:
    """Whoever left out large blobs does not know how large they are; one byte too many is counted."""
    for size, message in (
        (0, "is too large to have been fetched; the limit is 5,000,000"),
        (5_000_000, "is too large to have been fetched; the limit is 5,000,000"),
        (5_000_001, "is 5,000,001 bytes; the limit is 5,000,000"),
    ):
        problems = Problems()
        raw = Raw("submissions/a-b", None, (RawFile("predictions.csv", "file", size, None),))
        judge_folder(raw, problems)
        assert [p.message for p in problems] == [message]


def test_plain_paths_are_shown_as_they_are() -> None:
    """A backslash in a name is no reason to double it."""
    problems = Problems()
    judge_folder(Raw("submissions/X\\Y", "X\\Y", ()), problems)
    assert {p.file for p in problems} == {"submissions/X\\Y"}


def test_four_ids_of_one_name_are_counted() -> None:
    """With three the last is named too, with four the others are counted."""
    for ids, end in (
        (("a_1", "b/a_1_img", "a_1_map"), "; write one of these"),
        (("r_1", "r-redyellow_1", "r_1_map", "r_1_cue"), " or one of 2 others; write one of these"),
    ):
        assert Suggestions(ids).explain("r_1_img" if ids[0] == "r_1" else "a_1_img").endswith(end)


def test_every_rival_is_compared() -> None:
    """One of the same team, or one that shares too little, does not end the search."""
    mine = np.random.default_rng(1).uniform(0.05, 0.95, REFERENCE.n_trials).round(3)
    problems = Problems()
    own, far, copy = (
        dataclasses.replace(
            build_submission(REFERENCE, values.tolist()), slug=slug, metadata=build_metadata(team=team)
        )
        for values, slug, team in ((mine, "older", "Team"), (1 - mine, "far", "Far"), (mine, "copy", "Copy"))
    )
    nothing = np.zeros(REFERENCE.n_trials, bool)
    unanswered = dataclasses.replace(far, slug="empty", answered=nothing)
    this = dataclasses.replace(own, slug="mine")
    find_suspicions(this, REFERENCE, [own, unanswered, far, copy], "f", problems)
    assert [p.message for p in problems] == [
        f"the probabilities equal those of copy on {REFERENCE.n_trials} trials"
    ]


def test_people_are_recognised_where_one_person_answered() -> None:
    """Trials that a single person judged count like the others."""
    assert REFERENCE.people is not None
    n, n_yes = np.ones_like(REFERENCE.people.n), np.zeros_like(REFERENCE.people.n)
    n_yes[::3] = 1
    lonely = dataclasses.replace(
        REFERENCE, people=dataclasses.replace(REFERENCE.people, n=n, n_yes=n_yes, responses=None)
    )
    problems = Problems()
    find_suspicions(build_submission(lonely, n_yes.tolist()), lonely, (), "f", problems)
    assert [p.code for p in problems] == ["equal-to-human-means"]


@pytest.mark.parametrize("testing", ["with_property", "fully_observed"])
def test_the_state_is_more_than_a_track_shows(testing: str) -> None:
    """Unless the protocol says so, or there is no track to compare with."""
    open_track = REFERENCE.benchmark.default_track.model_copy(update={"testing": None})
    for tracks, codes in (((open_track,), ["beyond-track"]), ((), [])):
        benchmark = REFERENCE.benchmark.model_copy(update={"tracks": tracks})
        reference = dataclasses.replace(REFERENCE, benchmark=benchmark)
        metadata = build_metadata(testing=testing, inputs="state")
        plain = build_submission(reference, [0.5] * reference.n_trials)
        problems = Problems()
        judge_inputs(dataclasses.replace(plain, metadata=metadata), reference, "f", problems)
        assert [p.code for p in problems] == (codes if testing == "with_property" else [])


def test_the_same_answers_in_another_order_are_no_copy() -> None:
    """Two systems that say YES everywhere agree by chance; a copy ranks the trials alike, ties too."""
    rising = np.linspace(0.6, 0.9, REFERENCE.n_trials)
    tied = np.where(np.arange(REFERENCE.n_trials) < REFERENCE.n_trials - 3, 0.8, 0.7)
    for theirs, codes in ((rising[::-1], []), (rising + 0.01, ["copy-of-another"]), (tied, [])):
        mine, other = (
            dataclasses.replace(
                build_submission(REFERENCE, values.tolist()), slug=slug, metadata=build_metadata(team=slug)
            )
            for values, slug in ((rising, "mine"), (theirs, "theirs"))
        )
        problems = Problems()
        find_suspicions(mine, REFERENCE, [other], "f", problems)
        assert [p.code for p in problems] == codes


def test_a_day_ahead_is_not_the_future() -> None:
    """Somebody may live ahead of UTC by a day, and no more."""
    for days, codes in ((1, []), (2, ["date-in-future"])):
        date = (TODAY + dt.timedelta(days=days)).isoformat()
        assert [p.code for p in judge_toml(SUBMISSION_TOML.replace("2026-05-20", date))] == codes
