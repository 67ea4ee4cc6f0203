"""Reading published.csv: what is accepted, and what each mistake is told."""

from pathlib import Path

import pytest

from leaderboard.errors import SourceError
from leaderboard.files import csv_text
from leaderboard.reference.published import PUBLISHED_HEADER, read_published

ROW = {
    "source": "A paper",
    "system": "A",
    "scope": "Mass",
    "metric": "accuracy",
    "printed": "52.6",
    "n": "192",
}


def write(folder: Path, *rows: dict[str, str]) -> Path:
    """Write a file with these rows; columns that a row does not name are empty."""
    file = folder / "published.csv"
    file.write_text(csv_text(PUBLISHED_HEADER, ([row.get(c, "") for c in PUBLISHED_HEADER] for row in rows)))
    return file


def test_the_columns_are_those_of_the_contract() -> None:
    """In this order, with these names."""
    columns = "source,url,system,training,testing,training_trials,auxiliary,scope,metric,printed,n,note"
    assert ",".join(PUBLISHED_HEADER) == columns


def test_empty_cells_are_unknown_and_others_typed(tmp_path: Path) -> None:
    """Counts become numbers, what is printed stays text."""
    first, second = read_published(write(tmp_path, ROW, ROW | {"n": "", "training_trials": "2000"}))
    assert (first.n, first.printed, first.training_trials, first.url) == (192, "52.6", None, None)
    assert (second.n, second.training_trials) == (None, 2000)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"printed": ""}, "printed is empty"),
        ({"printed": "52,6"}, r"printed is '52,6': must be a number such as 52\.6, .*"),
        ({"n": "192.0"}, r"n is '192\.0'; it must be a whole number or empty"),
        ({"training_trials": "2,000"}, "training_trials is '2,000'; it must be a whole number or empty"),
        ({"testing": "w/ property"}, "testing is 'w/ property': Input should be 'with_property', .*"),
        ({"printed": "100/192", "n": "96"}, "printed is 100/192, but n is 96"),
    ],
)
def test_a_mistake_is_named_with_its_line(tmp_path: Path, changes: dict[str, str], message: str) -> None:
    """File, line, column, what was found and what would be right."""
    file = write(tmp_path, ROW, ROW | changes)
    with pytest.raises(SourceError, match=rf"^.*published\.csv:3: {message}$"):
        read_published(file)


def test_a_missing_column_is_named(tmp_path: Path) -> None:
    """The header must hold all columns; further ones are kept out of the way."""
    file = tmp_path / "published.csv"
    file.write_text("source,system\nA paper,A\n")
    with pytest.raises(SourceError, match=r"published\.csv:1: lacks the columns url, training, .*; found"):
        read_published(file)
