"""Whatever is done to people's files, nothing breaks and nobody is told."""

import functools
import re
from collections.abc import Mapping, Sequence

from hypothesis import example, given, settings
from hypothesis import strategies as st

from judgement_files import ANN, BOB, CAT, LONG, RAMP0, TRIALS, WALL1, make_file, read
from leaderboard.errors import SourceError
from leaderboard.reference.source_files import SourceFile
from release_stand_in import Layout, Release, Trap, traps_for

LAYOUTS = st.sampled_from(Layout)
MUTATIONS = st.lists(
    st.tuples(
        st.sampled_from(["cut", "double", "swap", "insert", "replace", "drop line", "double line"]),
        st.integers(0, 10**6),
        st.sampled_from(
            [",", '"', "\n", "\r\n", ";", "\t", "YES", "1", "-1", "nan", "Next", "0.5", "\u00e9", "/", "c"]
        ),
    ),
    min_size=1,
    max_size=6,
)  # fmt: skip


@functools.cache
def release_in(layout: Layout) -> Release:
    traps = [t for t in traps_for(layout) if t not in {Trap.NAMES_WITHOUT_COPY, Trap.UNKNOWN_TRIALS}]
    return Release(pairs_per_scenario=1, traps=traps, layout=layout, is_one_people_file=True)


def mutate(text: str, kind: str, place: int, piece: str) -> str:
    if kind.endswith("line"):
        lines = text.splitlines(keepends=True) or [""]
        at = place % len(lines)
        return "".join(lines[:at] + lines[at : at + 1] * (2 * ("double" in kind)) + lines[at + 1 :])
    at = place % (len(text) + 1)
    end = {"cut": len(text), "replace": at + len(piece)}.get(kind, at)
    middle = {
        "insert": piece,
        "replace": piece,
        "double": text[at : at + 40],
        "swap": text[at : at + 2][::-1],
    }
    return text[:at] + middle.get(kind, "") + text[end + 2 * (kind == "swap") :]


def outcome(file: SourceFile, *, trials: Mapping[str, bool], allow_unmatched: bool) -> tuple[str, bool]:
    """All that is told, and whether it is judgements, an error that says why there are none, or a refusal."""
    try:
        reading = read(file, trials=trials, allow_unmatched=allow_unmatched)
    except SourceError as error:
        return error.message, error.message.startswith(file.name)
    has_errors = any(problem.is_error for problem in reading.problems)
    return repr(reading), (reading.judgements is None) == has_errors


def lists_secret(text: str, secrets: Sequence[str]) -> list[str]:
    return [secret for secret in secrets if re.search(rf"(?<![\w]){re.escape(secret)}(?![\w])", text)]


@settings(max_examples=100)
@given(LAYOUTS, MUTATIONS, st.booleans())
@example(Layout.LONG, [("cut", 0, "")], False)
def test_mutated_files_are_read_or_refused(
    layout: Layout, mutations: list[tuple[str, int, str]], allow_unmatched: bool
) -> None:
    """A damaged file gives judgements, an error among the problems, or a refusal that names file and line."""
    release = release_in(layout)
    ((name, content),) = release.people_files.items()
    text = content.decode("utf-8-sig")
    for mutation in mutations:
        text = mutate(text, *mutation)
    shown, is_settled = outcome(
        SourceFile(name, name, text.encode()), trials=release.truth.labels, allow_unmatched=allow_unmatched
    )
    assert is_settled, shown
    ids = [person for person, _, _ in release.sittings]
    assert lists_secret(shown, ids) == []


CELLS = st.sampled_from(
    [
        ANN,
        BOB,
        CAT,
        RAMP0,
        WALL1,
        f"{RAMP0}9",
        "YES",
        "NO",
        "1",
        "0",
        "",
        "Next",
        "maybe",
        "0.5",
        "7",
        "practice",
    ]
)
COLUMNS = st.sampled_from(
    [*LONG, ANN, BOB, CAT, RAMP0, WALL1, "gameID", "correct", "label", "c", "n_yes", "choices", "said", ""]
)
ROLES = st.sampled_from(["participant", "trial", "response", "correct", "label", "count", "n_yes"])


@given(st.data())
def test_any_table_is_read_or_refused_without_naming_anybody(data: st.DataObject) -> None:
    """Whatever cells stand in whatever columns, and whatever these are said to hold, no id gets out."""
    header = data.draw(st.lists(COLUMNS, min_size=1, max_size=6, unique=True))
    rows = data.draw(st.lists(st.lists(CELLS, min_size=len(header), max_size=len(header)), min_size=1))
    columns = data.draw(
        st.dictionaries(ROLES, st.sampled_from([c for c in header if c not in {ANN, BOB, CAT}] or ["x"]))
    )
    reading = read(make_file(header, rows), columns=columns, allow_unmatched=data.draw(st.booleans()))
    assert (reading.judgements is None) == any(problem.is_error for problem in reading.problems)
    assert [person for person in (ANN, BOB, CAT) if person in repr(reading)] == []
    if reading.judgements is not None:
        assert reading.judgements.ratings.keys() <= TRIALS.keys()
        assert all(0 <= rating.n_yes <= rating.n for rating in reading.judgements.ratings.values())
