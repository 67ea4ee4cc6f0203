"""Small files of human data, and reading them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from leaderboard.files import csv_text
from leaderboard.problems import Problem, Problems
from leaderboard.reference.judgements import JudgementOptions, Judgements, parse_judgements
from leaderboard.reference.source_files import SourceFile

RAMP0, RAMP1 = "ramp_pp-copy0/zone=far/0001", "ramp_pp-copy1/zone=far/0001"
WALL0, WALL1 = "wall_pp-copy0/size=1,2/0004", "wall_pp-copy1/size=1,2/0004"
TRIALS = {RAMP0: True, RAMP1: False, WALL0: True, WALL1: False}
ANN, BOB, CAT = "5f1c8a0b77aa", "60aa31f2c0de", "61bb9e0d4f55"
LONG = ("prolificID", "stim_ID", "response")


@dataclass(frozen=True)
class Reading:
    """What a test looks at: the judgements, and the problems."""

    judgements: Judgements | None
    problems: tuple[Problem, ...]

    @property
    def codes(self) -> list[str]:
        """The codes of all problems but the two notes that every file gets."""
        return [p.code for p in self.problems if p.code not in {"import-layout", "import-match"}]

    @property
    def counts(self) -> dict[str, tuple[int, int]]:
        """Answers, and YES among them, by trial."""
        assert self.judgements is not None, self.problems
        return {trial_id: (r.n, r.n_yes) for trial_id, r in self.judgements.ratings.items()}

    def find(self, code: str) -> Problem:
        """Return the one problem with this code."""
        (problem,) = [p for p in self.problems if p.code == code]
        return problem


def make_file(
    header: Sequence[str], rows: Sequence[Sequence[object]], name: str = "people.csv"
) -> SourceFile:
    return SourceFile(name, name, csv_text(header, rows).encode())


def read(
    *files: SourceFile,
    columns: Mapping[str, str] | None = None,
    allow_unmatched: bool = False,
    trials: Mapping[str, bool] = TRIALS,
) -> Reading:
    problems = Problems()
    options = JudgementOptions(columns or {}, allow_unmatched)
    return Reading(parse_judgements(files, trials, options, problems), tuple(problems))


def read_rows(
    header: Sequence[str],
    rows: Sequence[Sequence[object]],
    *,
    columns: Mapping[str, str] | None = None,
    allow_unmatched: bool = False,
) -> Reading:
    return read(make_file(header, rows), columns=columns, allow_unmatched=allow_unmatched)
