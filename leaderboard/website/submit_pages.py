"""The page that says how to submit, with what the validator answers to common mistakes in a file."""

import csv
import datetime as dt
import io
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from leaderboard.instance import PREDICTIONS_FILE
from leaderboard.reference import Reference
from leaderboard.report.problems import render_problems
from leaderboard.submission import RawFile, RawSubmission
from leaderboard.validation import validate
from leaderboard.website.describing import count_of
from leaderboard.website.material import Material
from leaderboard.website.pages import Fact, Page

N_EXAMPLES = 3
ROW = 1
"""Which row below the header the mistakes are made in."""

EVER = dt.date.max
"""A bare file of predictions has no date that could lie in the future."""

Rows = list[list[str]]


@dataclass(frozen=True)
class Mistake:
    """A mistake in a file of predictions: what it is, a line that shows it, and what the validator says."""

    title: str
    line: str
    answer: str


@dataclass(frozen=True)
class SubmitPage(Page):
    """How to submit.

    Attributes
    ----------
    example
        The first lines of a valid file.
    sizes
        How many trials each property has.
    steps
        What is done, and by which command.
    tracks
        What a submission of each track says of itself.
    mistakes
        What can be wrong with a file.
    """

    example: str
    sizes: tuple[Fact, ...]
    steps: tuple[Fact, ...]
    tracks: tuple[Fact, ...]
    mistakes: tuple[Mistake, ...]


def compose_submit(material: Material) -> SubmitPage:
    """Gather what the page shows; every answer is the validator's own."""
    reference = material.reference
    asked = f"“{reference.benchmark.question}” One probability of YES for each of"
    n_trials = count_of(reference.n_trials, "trial")
    return SubmitPage(
        path="submit.html",
        title="Submit",
        summary=f"{asked} {n_trials}, checked and graded on your machine, then sent as a pull request.",
        example=_write_rows(_list_rows(reference)[: N_EXAMPLES + 1]),
        sizes=tuple(_list_sizes(material)),
        steps=tuple(_list_steps()),
        tracks=tuple(_describe_tracks(material)),
        mistakes=tuple(_make_mistakes(reference)),
    )


def _list_sizes(material: Material) -> Iterator[Fact]:
    benchmark = material.reference.benchmark
    for property_ in benchmark.properties:
        scenarios = len(benchmark.scenarios_of(property_.name))
        size = count_of(material.count(property_.name).n, "trial")
        yield Fact(property_.name, f"{size} in {count_of(scenarios, 'scenario')}: reference/{property_.file}")


def _list_steps() -> Iterator[Fact]:
    yield Fact("Check the file", "leaderboard validate predictions.csv", is_code=True)
    yield Fact("See its scores", "leaderboard grade predictions.csv", is_code=True)
    yield Fact("Make the submission", "leaderboard submit predictions.csv", is_code=True)
    yield Fact("Send it", "leaderboard submit submissions/SLUG --pr", is_code=True)


def _describe_tracks(material: Material) -> Iterator[Fact]:
    for track in material.reference.benchmark.tracks:
        said = ", ".join(f'{key} = "{value}"' for key, value in track.conditions.items())
        yield Fact(track.title, said or "any protocol", is_code=bool(said))


def _list_rows(reference: Reference) -> Rows:
    """Write a valid file in the order of the reference, whose probabilities say nothing."""
    rows = [[trial_id, f"0.{5 + index % 2}"] for index, trial_id in enumerate(reference.trial_ids)]
    return [["trial_id", "probability"], *rows]


def _write_rows(rows: Sequence[Sequence[str]], separator: str = ",") -> str:
    stream = io.StringIO()
    csv.writer(stream, delimiter=separator, lineterminator="\n").writerows(rows)
    return stream.getvalue()


def _make_mistakes(reference: Reference) -> Iterator[Mistake]:
    for title, write in _MISTAKES.items():
        content = write(_list_rows(reference))
        answer = _ask_validator(content, reference)
        if answer:  # where a scenario has one trial, leaving it out leaves all of the scenario out
            yield Mistake(title, content.splitlines()[ROW], answer)


def _ask_validator(content: str, reference: Reference) -> str:
    """Give the first thing that the validator finds wrong, as it is printed on a terminal."""
    file = RawFile(PREDICTIONS_FILE, "file", len(content.encode()), content.encode())
    raw = RawSubmission(PREDICTIONS_FILE, None, (file,))
    errors = [problem for problem in validate(raw, reference, today=EVER).problems if problem.is_error]
    return render_problems(errors[:1])


def _write_cell(rows: Rows, column: int, text: str) -> str:
    rows[ROW][column] = text
    return _write_rows(rows)


_MISTAKES: dict[str, Callable[[Rows], str]] = {
    "Columns separated by semicolons": lambda rows: _write_rows(rows, ";"),
    "A decimal comma": lambda rows: _write_cell(rows, 1, "0,73"),
    "A percentage": lambda rows: _write_cell(rows, 1, "73%"),
    "A score instead of a probability": lambda rows: _write_cell(rows, 1, "1.7"),
    "No number": lambda rows: _write_cell(rows, 1, ""),
    "A letter too many in an id": lambda rows: _write_cell(rows, 0, f"{rows[ROW][0]}x"),
    "A trial left out": lambda rows: _write_rows([*rows[:ROW], *rows[ROW + 1 :]]),
    "A trial given twice": lambda rows: _write_rows([*rows, rows[ROW]]),
}
"""Every one is really made, in a file that has nothing else wrong with it."""
