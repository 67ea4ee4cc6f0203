"""Bars are for people who watch."""

import io

import pytest
from rich.console import Console

from leaderboard.reference.fetching.progress import SILENT, following
from leaderboard.reference.fetching.progress_bar import ProgressBar


@pytest.mark.parametrize("total", [1000, None])
def test_a_terminal_is_drawn_on(total: int | None) -> None:
    """A bar with its name appears, whose brackets are not taken for markup, and is gone in the end."""
    stream = io.StringIO()
    bar = ProgressBar(Console(file=stream, force_terminal=True, width=100))
    with following(bar, "lists [red]", total):
        bar.advance(500)
    assert "lists [red]" in stream.getvalue()
    assert stream.getvalue().endswith("\x1b[2K")  # the line is erased


def test_anything_else_is_not() -> None:
    """In a file or a pipe nothing appears."""
    stream = io.StringIO()
    bar = ProgressBar(Console(file=stream, force_terminal=False))
    with following(bar, "lists", 1000):
        bar.advance(1000)
    assert stream.getvalue() == ""


def test_standard_error_is_meant(capsys: pytest.CaptureFixture[str]) -> None:
    """By default it is about stderr, which is no terminal here, and stdout stays for results."""
    with following(ProgressBar(), "lists", 1000):
        pass
    assert capsys.readouterr() == ("", "")


def test_a_bar_that_was_not_started() -> None:
    """Outside a transfer it has nothing to draw."""
    bar = ProgressBar()
    bar.advance(1)
    bar.finish()


def test_a_transfer_that_fails_is_finished() -> None:
    """Nothing stays on the screen, and the failure passes."""
    with pytest.raises(ZeroDivisionError), following(SILENT, "lists", None):
        SILENT.advance(1 // 0)
