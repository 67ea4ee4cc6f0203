"""Telling how far a transfer is."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Protocol


class Progress(Protocol):
    """Follows one transfer after the other."""

    def start(self, what: str, total: int | None) -> None:
        """Begin a transfer of so many bytes; None if that is not known."""

    def advance(self, n_bytes: int) -> None:
        """Note that so many more bytes are there."""

    def finish(self) -> None:
        """End the transfer, done or not."""


class _Silent:
    def start(self, what: str, total: int | None) -> None:
        pass

    def advance(self, n_bytes: int) -> None:
        pass

    def finish(self) -> None:
        pass


SILENT: Progress = _Silent()


@contextmanager
def following(progress: Progress, what: str, total: int | None) -> Iterator[None]:
    """Start a transfer, and finish it whatever happens."""
    progress.start(what, total)
    try:
        yield
    finally:
        progress.finish()
