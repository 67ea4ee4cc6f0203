"""A stand-in of the official release: files in every dialect and with every trap, and the truth behind them.

Use it so::

    release = Release(pairs_per_scenario=4, list_names=ListNames.PAPER, traps=[Trap.CRLF, Trap.READOUT_LIST])
    test_zip, human_zip = release.write_zips(tmp_path)
    assert import_somehow(test_zip, human_zip).labels == release.truth.labels

The official files themselves were not at hand: names, columns and oddities are those that their users and the
authors' scripts tell of.
"""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from release_archives import SPARSE_SIZE, write_sparse_zip, write_zip
from release_layouts import write_people
from release_lists import POSIX_ROOT, WINDOWS_ROOT, Columns, ListDialect, ListNames, write_lists
from release_media import N_WITH_MEDIA, junk_members, media_members, readout_members
from release_people import PeopleDialect, make_rows
from release_touched import Making, lost_answers, secrets_of, touched_by
from release_traps import LIST_TRAPS, PEOPLE_TRAPS, Layout, Trap, traps_for
from release_trials import (
    PEOPLE_OF_SMALL_RELEASE,
    PEOPLE_PER_PROPERTY,
    Answer,
    Sitting,
    Trial,
    ask_people,
    make_trials,
)

__all__ = [
    "LIST_TRAPS",
    "PEOPLE_TRAPS",
    "POSIX_ROOT",
    "SPARSE_SIZE",
    "WINDOWS_ROOT",
    "Answer",
    "Columns",
    "Layout",
    "ListNames",
    "Release",
    "Trap",
    "Truth",
    "answer_sheets",
    "traps_for",
]

TEST_FOLDER, HUMAN_FOLDER = "testdata_v1", "human_data"
Sheet = tuple[tuple[str, bool], ...]


@dataclass(frozen=True)
class Truth:
    """What an import should find.

    Attributes
    ----------
    labels, start_frames
        Of each trial, by its id; trials of unknown scenarios and training trials are not among them.
    responses
        What people answered to test trials, without practice, lost and repeated answers.
    touched
        Whom or what each trap befell; `Trap` says in what terms.
    secrets
        Texts of people's files that must not get anywhere: ids, comments, addresses.
    """

    labels: Mapping[str, bool]
    start_frames: Mapping[str, int]
    responses: tuple[Answer, ...]
    touched: Mapping[Trap, tuple[str, ...]]
    secrets: frozenset[str] = field(repr=False)

    @property
    def counts(self) -> dict[str, tuple[int, int]]:
        """Number of answers, and of YES among them, of each trial that has any."""
        counts: dict[str, tuple[int, int]] = {}
        for _, trial_id, is_yes in self.responses:
            n, n_yes = counts.get(trial_id, (0, 0))
            counts[trial_id] = (n + 1, n_yes + is_yes)
        return counts


def answer_sheets(responses: Collection[tuple[str, str, bool]]) -> list[Sheet]:
    """List what each person answered, without saying who: equal for responses that differ in ids only."""
    sheets: dict[str, list[tuple[str, bool]]] = {}
    for person, trial_id, is_yes in responses:
        sheets.setdefault(person, []).append((trial_id, bool(is_yes)))
    return sorted(tuple(sorted(sheet)) for sheet in sheets.values())


@dataclass(frozen=True)
class Release:
    """A release in one dialect; equal options give equal bytes.

    Parameters
    ----------
    seed
        Which trials, labels and people.
    pairs_per_scenario
        None for the official numbers (768 trials, 50 people for each property); a small number for speed,
        then with 10 people for each property.
    traps
        What is odd.
    list_names, columns, has_index, root
        The lists: their family of names, their columns, whether an unnamed index column leads, and the folder
        at which absolute paths begin; one with backslashes makes Windows paths.
    layout, is_one_people_file, answers
        People's files: their layout, whether one file or one for each property, how YES and NO are spelled.
    has_all_media
        Every trial has its videos, states and pickles, so that the archive's directory is as long as it must
        be; otherwise only a few have.

    Raises
    ------
    ValueError
        If the layout cannot hold a trap; see `traps_for`.
    """

    seed: int = 0
    pairs_per_scenario: int | None = None
    traps: Collection[Trap] = ()
    list_names: ListNames = ListNames.MERGED
    columns: Columns = Columns.CURRENT
    has_index: bool = False
    root: str = POSIX_ROOT
    layout: Layout = Layout.LONG
    is_one_people_file: bool = False
    answers: tuple[str, str] = ("YES", "NO")
    has_all_media: bool = False

    def __post_init__(self) -> None:
        impossible = [trap.name for trap in self.traps if trap not in traps_for(self.layout)]
        if impossible:
            raise ValueError(f"the layout {self.layout.name} cannot hold {', '.join(impossible)}")

    @cached_property
    def trials(self) -> tuple[Trial, ...]:
        """The test trials in the order of their lists."""
        return make_trials(self.seed, self.pairs_per_scenario, self.traps)

    @cached_property
    def sittings(self) -> tuple[Sitting, ...]:
        """What each person answered, in order."""
        n_people = PEOPLE_PER_PROPERTY if self.pairs_per_scenario is None else PEOPLE_OF_SMALL_RELEASE
        return ask_people(self.seed, self.trials, n_people, self.traps)

    @cached_property
    def truth(self) -> Truth:
        """What the files stand for."""
        lost = lost_answers(self.sittings, self.traps)
        making = Making(
            self.trials, self.sittings, self.list_dialect, self.people_dialect, self.pairs_per_scenario
        )
        return Truth(
            labels={trial.trial_id: trial.label for trial in self.trials},
            start_frames={trial.trial_id: trial.start_frame for trial in self.trials},
            responses=tuple(a for sitting in self.sittings for a in sitting.answers if a not in lost),
            touched=touched_by(making),
            secrets=secrets_of(making),
        )

    @property
    def list_dialect(self) -> ListDialect:
        """How the lists are written."""
        return ListDialect(self.list_names, self.columns, self.has_index, self.root, self.traps)

    @property
    def people_dialect(self) -> PeopleDialect:
        """How people's files are written."""
        return PeopleDialect(self.layout, self.is_one_people_file, self.answers, self.traps, self.seed)

    @cached_property
    def list_files(self) -> dict[str, bytes]:
        """The lists of test trials, by name."""
        return write_lists(self.trials, self.list_dialect)

    @cached_property
    def people_files(self) -> dict[str, bytes]:
        """People's files, by name."""
        return write_people(make_rows(self.sittings, self.trials, self.people_dialect), self.people_dialect)

    @cached_property
    def test_members(self) -> dict[str, bytes]:
        """What ``test_data.zip`` holds: the lists amid everything else."""
        lists = {f"{TEST_FOLDER}/{name}": content for name, content in self.list_files.items()}
        shown = self.trials if self.has_all_media else self.trials[:N_WITH_MEDIA]
        media = media_members(TEST_FOLDER, shown, self.traps)
        readout = readout_members(TEST_FOLDER, self.trials, self.list_dialect, self.seed)
        return {**media, **lists, **readout, **junk_members(TEST_FOLDER, self.list_files)}

    @cached_property
    def human_members(self) -> dict[str, bytes]:
        """What ``human_data.zip`` holds."""
        people = {f"{HUMAN_FOLDER}/{name}": content for name, content in self.people_files.items()}
        return {**people, **junk_members(HUMAN_FOLDER, self.people_files)}

    def write_folder(self, path: Path) -> Path:
        """Write both archives unpacked into a folder, and return it."""
        for name, content in {**self.test_members, **self.human_members}.items():
            file = path / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(content)
        return path

    def write_zips(self, path: Path, *, sparse_size: int | None = None) -> tuple[Path, Path]:
        """Write ``test_data.zip`` and ``human_data.zip`` into a folder, and return where they are.

        With ``sparse_size=SPARSE_SIZE`` the first claims so many bytes, most of them holes in the file, and
        the lists lie behind them.
        """
        path.mkdir(parents=True, exist_ok=True)
        test_zip, human_zip = path / "test_data.zip", path / "human_data.zip"
        if sparse_size is None:
            write_zip(test_zip, self.test_members)
        else:
            write_sparse_zip(test_zip, self.test_members, TEST_FOLDER, sparse_size)
        write_zip(human_zip, self.human_members)
        return test_zip, human_zip
