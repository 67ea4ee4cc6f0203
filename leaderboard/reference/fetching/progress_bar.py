"""A bar on the terminal for each transfer."""

from rich.console import Console
from rich.progress import (
    BarColumn,
    DownloadColumn,
    Progress,
    TaskID,
    TextColumn,
    TimeRemainingColumn,
    TransferSpeedColumn,
)


class ProgressBar:
    """Draws on stderr while a transfer lasts, and only if stderr is a terminal.

    Parameters
    ----------
    console
        Where to draw instead.
    """

    def __init__(self, console: Console | None = None) -> None:
        self._console = Console(stderr=True) if console is None else console
        self._bar: Progress | None = None
        self._task = TaskID(0)

    def start(self, what: str, total: int | None) -> None:
        """Draw a new bar; one without end if the total is not known."""
        self._bar = Progress(
            TextColumn("{task.description}", markup=False),
            BarColumn(),
            DownloadColumn(),
            TransferSpeedColumn(),
            TimeRemainingColumn(),
            console=self._console,
            disable=not self._console.is_terminal,
            transient=True,
        )
        self._task = self._bar.add_task(what, total=total)
        self._bar.start()

    def advance(self, n_bytes: int) -> None:
        """Lengthen the bar."""
        if self._bar is not None:
            self._bar.advance(self._task, n_bytes)

    def finish(self) -> None:
        """Remove the bar."""
        if self._bar is not None:
            self._bar.stop()
            self._bar = None
