"""People's files of the release, as far as it is known: every layout and every trap, alone and together."""

import pytest

from judgement_files import Reading, read
from leaderboard.reference.source_files import SourceFile
from release_stand_in import PEOPLE_TRAPS, Layout, Release, Trap, answer_sheets, traps_for

REFUSED = {Trap.UNKNOWN_TRIALS, Trap.NAMES_WITHOUT_COPY}
FINDINGS = {
    Trap.PRACTICE_TRIALS: "import-practice",
    Trap.PRACTICE_ON_TEST_TRIALS: "import-practice",
    Trap.NEXT_RESPONSES: "import-non-answer",
    Trap.EMPTY_RESPONSES: "import-non-answer",
    Trap.CONTRADICTED_RESPONSES: "import-answer-contradiction",
    Trap.DISAGREEING_LABELS: "import-people-label",
    Trap.DUPLICATE_ANSWERS: "import-same-answer",
    Trap.CHANGED_ANSWERS: "import-changed-answer",
    Trap.UNKNOWN_TRIALS: "import-match-rate",
    Trap.NAMES_WITHOUT_COPY: "import-match-rate",
}
TOGETHER = {*PEOPLE_TRAPS, Trap.CRLF, Trap.BYTE_ORDER_MARK, Trap.CONFIG_COMMAS, Trap.BLANK_LINES} - {
    Trap.NAMES_WITHOUT_COPY
}
CASES = [(layout, trap) for layout in Layout for trap in PEOPLE_TRAPS if trap in traps_for(layout)]


def read_release(release: Release, *, allow_unmatched: bool = False) -> Reading:
    files = [SourceFile(name, name, content) for name, content in release.people_files.items()]
    return read(*files, trials=release.truth.labels, allow_unmatched=allow_unmatched)


def assert_true(reading: Reading, release: Release) -> None:
    assert reading.counts == release.truth.counts
    assert reading.judgements is not None
    responses = reading.judgements.responses
    assert (responses is None) == (release.layout is Layout.AGGREGATED)
    if responses is not None:
        found = answer_sheets([(r.participant_id, r.trial_id, r.is_yes) for r in responses])
        assert found == answer_sheets(release.truth.responses)


@pytest.mark.parametrize(
    ("layout", "trap"), CASES, ids=[f"{layout.name}-{trap.name}" for layout, trap in CASES]
)
def test_each_trap_ends_in_the_truth_or_in_a_finding(layout: Layout, trap: Trap) -> None:
    """Answers are those that people gave; what cannot be matched is refused; every odd row is named."""
    release = Release(pairs_per_scenario=6, traps=[trap], layout=layout)
    reading = read_release(release)
    if trap in REFUSED:
        assert reading.judgements is None
    else:
        assert_true(reading, release)
    is_named = layout is Layout.LONG or trap in REFUSED or trap is Trap.PRACTICE_TRIALS
    if is_named and trap in FINDINGS:
        assert FINDINGS[trap] in reading.codes


@pytest.mark.parametrize("layout", Layout)
@pytest.mark.parametrize("is_one_file", [True, False])
@pytest.mark.parametrize("answers", [("YES", "NO"), ("1", "0"), ("True", "False")])
def test_all_traps_together_end_in_the_truth(
    layout: Layout, is_one_file: bool, answers: tuple[str, str]
) -> None:
    """With every oddity at once the answers are those that people gave, and nobody can be identified."""
    traps = [trap for trap in traps_for(layout) if trap in TOGETHER - {Trap.RESPONSELESS, Trap.LABELLESS}]
    release = Release(
        pairs_per_scenario=6, traps=traps, layout=layout, is_one_people_file=is_one_file, answers=answers
    )
    reading = read_release(release, allow_unmatched=True)
    assert_true(reading, release)
    shown = repr(reading)
    assert [secret for secret in release.truth.secrets if secret in shown] == []


def test_release_of_official_size_is_read_whole() -> None:
    """200 people with 32 answers each are 6,400 answers, all of which name a trial."""
    release = Release(is_one_people_file=True)
    reading = read_release(release)
    assert_true(reading, release)
    assert reading.find("import-match").message == "6,400 of 6,400 answers name a trial"
    assert reading.judgements is not None
    assert reading.judgements.account.n_participants == 200
