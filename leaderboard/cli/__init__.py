"""The command line: parse, call the library, print. A command's module is loaded when it is called."""

import gc
import importlib
import os
import sys
from pathlib import Path
from typing import NoReturn

import click

from leaderboard import __version__
from leaderboard.cli.location import Location
from leaderboard.errors import LeaderboardError

# Start-up and safety: pydantic would otherwise search every installed package for plugins and run them.
os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
# Matrices are small here: more threads gain little, and on a busy machine they wait for each other.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

COMMANDS = {
    "validate": "Check submission folders or prediction files; report every problem at once.",
    "grade": "Validate and score submission folders or prediction files.",
    "submit": "Make submissions/<slug>/ from prediction files: valid and graded, or nothing.",
    "rank": "Print the board of a track.",
    "compare": "Compare two submissions by pairs: differences with intervals and exact tests.",
    "verify": "Grade everything again and prove every committed result.",
    "check-changes": "Check what a branch changes: one submission, by its contact, with the right result.",
    "ledger": "Check or extend the ledger, the public record of what was published.",
    "site": "Build or serve the website.",
    "reference": "Show, check, seal, fetch, import or synthesize the reference data.",
    "convert": "Turn other tools' logs into predictions.csv.",
    "readout": "Fit the paper's readout to features: predictions, a report and a plot.",
    "baselines": "Write the baselines (chance, always YES, human mean, label oracle) as submissions.",
    "audit": "Check whether published numbers are possible, consistent and better than chance.",
}


class LazyGroup(click.Group):
    """A group that knows its commands by name and imports one only when it runs."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Name the commands in the order in which they are used."""
        del ctx
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import a command, or return None if there is none of that name."""
        del ctx
        if cmd_name not in COMMANDS:
            return None
        command: click.Command = importlib.import_module(
            f"leaderboard.cli.{cmd_name.replace('-', '_')}"
        ).command
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List the commands with their one-line help, without importing them."""
        del ctx
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))

    def invoke(self, ctx: click.Context) -> object:
        """Run a command; what is wrong outside the program becomes one line and exit status 1."""
        try:
            return super().invoke(ctx)
        except LeaderboardError as error:
            _fail(error.message, error.hint)
        except BrokenPipeError:
            raise
        except OSError as error:
            where = f"{error.filename}: " if error.filename else ""
            _fail(f"{where}{error.strerror or error}", "")


def _fail(message: str, hint: str) -> NoReturn:
    """Say what is wrong; messages may quote names of files and what others wrote."""
    from leaderboard.report.problems import escape_line

    for line in f"error: {message}".split("\n") + [f"  {line}" for line in hint.split("\n") if line]:
        click.echo(escape_line(line), err=True)
    sys.exit(1)


@click.group(cls=LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, message="%(prog)s %(version)s")
@click.option(
    "--root",
    type=click.Path(path_type=Path, file_okay=False),
    help="The leaderboard's folder; without it, the nearest one upward that holds reference/benchmark.toml.",
)
@click.pass_context
def group(ctx: click.Context, root: Path | None) -> None:
    """Grade predictions against a physical-reasoning benchmark and publish an honest leaderboard."""
    ctx.obj = Location(root)


def main() -> NoReturn:
    """Run the command line as a process of its own.

    The process ends at once when all is written: taking the interpreter apart module by module would take
    longer than judging a submission.
    """
    gc.set_threshold(1_000_000)  # a command is short: looking for garbage at each step only costs
    code = 1
    try:
        group.main(prog_name="leaderboard")
    except SystemExit as stop:
        code = stop.code if isinstance(stop.code, int) else int(stop.code is not None)
    try:
        sys.stdout.flush()
        sys.stderr.flush()
    except OSError:
        code = code or 1
    os._exit(code)
