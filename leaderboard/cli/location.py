"""What commands share: the instance they work on, where they print, and what day it is."""

import datetime as dt
import os
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # start-up: help and version need none of these
    from leaderboard.instance import Instance
    from leaderboard.reference import Reference
    from leaderboard.report.terminal import Terminal

MIN_WIDTH = 80
PIPE_WIDTH = 132


@dataclass(frozen=True)
class Location:
    """The ``--root`` option, and what follows from it."""

    root: Path | None

    def find_instance(self) -> "Instance":
        """The instance that ``--root`` names, or the nearest one upward."""
        from leaderboard.instance import BENCHMARK_FILE, Instance, find_instance

        if self.root is None:
            return find_instance(Path.cwd())
        instance = Instance(self.root)
        if not instance.benchmark_file.is_file():
            from leaderboard.errors import InstanceError

            raise InstanceError(f"{self.root} is no leaderboard: it has no reference/{BENCHMARK_FILE}")
        return instance

    def load_reference(self, *, with_responses: bool = True) -> "tuple[Instance, Reference]":
        """Find the instance and load its reference, with or without the responses of single people."""
        from leaderboard.reference import load_reference

        instance = self.find_instance()
        return instance, load_reference(instance, with_responses=with_responses)

    def new_instance(self) -> "Instance":
        """The one that ``--root`` names, there or not; without it, the nearest or else the current folder."""
        from leaderboard.errors import InstanceError
        from leaderboard.instance import Instance, find_instance

        if self.root is not None:
            return Instance(self.root)
        try:
            return find_instance(Path.cwd())
        except InstanceError:
            return Instance(Path.cwd())


def today() -> dt.date:
    """Today's date in UTC; everything that depends on the day is told it from here."""
    return dt.datetime.now(dt.UTC).date()


def current_terminal() -> "Terminal":
    """Describe standard output: its width, and colours if it is a terminal and NO_COLOR is not set."""
    from leaderboard.report.terminal import Terminal

    is_terminal = sys.stdout.isatty()
    width = shutil.get_terminal_size((PIPE_WIDTH, 24)).columns if is_terminal else PIPE_WIDTH
    return Terminal(max(width, MIN_WIDTH), has_colour=is_terminal and not os.environ.get("NO_COLOR"))
