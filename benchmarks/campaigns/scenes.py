"""A small instance, the commands that write into it, and whether what is there is whole."""

import io
import os
import shutil
import sys
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))

from leaderboard.cli import group  # noqa: E402  (the tests' folder comes first)
from leaderboard.files import TEMPORARY_PREFIX  # noqa: E402
from leaderboard.instance import LEDGER_FILE, RESULT_FILE  # noqa: E402
from raw_submissions import SUBMISSION_TOML  # noqa: E402
from reference_folders import HEADERS, ReferenceFolder, sound_rows  # noqa: E402

Files = dict[str, bytes]

DATE = ("--date", "2026-05-20")
SUBMIT = (
    "--name", "Second", "--team", "Team", *DATE, "--description", "One.", "--training", "separate",
    "--testing", "with_property", "--family", "other", "--inputs", "rgb", "--github", "someone",
)  # fmt: skip
PREDICTIONS = "mine.csv"
OLD_RESULT = b'{"what": "stood here before"}\n'


@dataclass(frozen=True)
class Scene:
    """A command that writes, and the files below ``submissions/`` before and after it."""

    arguments: tuple[str, ...]
    before: Files
    after: Files


def make_instance(root: Path) -> None:
    """Write a reference of twelve trials, and predictions for them beside it."""
    ReferenceFolder().write(root)
    (root / "submissions").mkdir()
    rows = sound_rows()
    trials = [row[0] for name in HEADERS if not name.startswith("human") for row in rows[name]]
    lines = [f'"{trial}",0.{number + 11}\n' for number, trial in enumerate(trials)]
    (root / PREDICTIONS).write_text("".join(["trial_id,probability\n", *lines]))


def submit_arguments(root: Path, slug: str) -> tuple[str, ...]:
    """Name the command that makes a submission of the predictions beside the instance."""
    return ("submit", str(root / PREDICTIONS), "--slug", slug, *SUBMIT)


def run_command(root: Path, arguments: tuple[str, ...]) -> int:
    """Run a command in this process and return its exit status."""
    try:
        group.main(["--root", str(root), *arguments], prog_name="leaderboard")
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else int(stop.code is not None)


def run_quietly(root: Path, arguments: tuple[str, ...]) -> int:
    """Run a command in a process of its own, which is forked from this one, and return its exit status."""
    return os.waitstatus_to_exitcode(os.waitpid(start_quietly(root, arguments), 0)[1])


def start_quietly(root: Path, arguments: tuple[str, ...]) -> int:
    """Start such a process and return its id."""
    child = os.fork()
    if child:
        return child
    silence = os.open(os.devnull, os.O_WRONLY)
    for descriptor in (1, 2):
        os.dup2(silence, descriptor)
    os._exit(run_command(root, arguments))


def read_files(root: Path) -> Files:
    """Read all that is below ``submissions/``, half-written leftovers aside."""
    folder = root / "submissions"
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and TEMPORARY_PREFIX not in path.relative_to(folder).as_posix()
    }


def count_leftovers(root: Path) -> int:
    """Count what is half-written below ``submissions/``."""
    return len(list((root / "submissions").rglob(f"{TEMPORARY_PREFIX}*")))


def lay(root: Path, contents: Files) -> None:
    """Put these files and no others below ``submissions/``."""
    folder = root / "submissions"
    shutil.rmtree(folder)
    folder.mkdir()
    for name, content in contents.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_bytes(content)


def make_scenes(root: Path) -> dict[str, Scene]:
    """Make an instance and each scene, by running its command once undisturbed."""
    make_instance(root)
    predictions = (root / PREDICTIONS).read_bytes()
    first = {"first/submission.toml": SUBMISSION_TOML.encode(), "first/predictions.csv": predictions}
    lay(root, first)
    grade = ("grade", str(root / "submissions/first"))
    prepare(root, grade)
    graded = read_files(root)
    prepare(root, ("ledger", "update", *DATE))
    recorded = read_files(root)
    prepare(root, ("baselines", "--date", "2026-05-19"))
    with_baselines = read_files(root)
    old_ledger = with_baselines | {LEDGER_FILE: recorded[LEDGER_FILE]}
    starts: dict[str, tuple[tuple[str, ...], Files]] = {
        "grade": (grade, first | {f"first/{RESULT_FILE}": OLD_RESULT}),
        "submit": (submit_arguments(root, "second"), graded),
        "ledger update": (("ledger", "update", *DATE), old_ledger),
        "baselines": (("baselines", *DATE), with_baselines),
    }
    return {name: _play(root, *start) for name, start in starts.items()}


def _play(root: Path, arguments: tuple[str, ...], before: Files) -> Scene:
    lay(root, before)
    prepare(root, arguments)
    return Scene(arguments, before, read_files(root))


def prepare(root: Path, arguments: tuple[str, ...]) -> None:
    """Run a command that must succeed, in this process: what it loads, forked ones have then.

    Raises
    ------
    RuntimeError
        If it does not.
    """
    with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
        status = run_command(root, arguments)
    if status:
        raise RuntimeError(f"leaderboard {' '.join(arguments)} fails undisturbed")


def find_torn(scene: Scene, found: Files) -> list[str]:
    """Name the files that are neither as before nor as after, are lost, or are part of a folder."""
    torn = [name for name, content in found.items() if content not in _versions(scene, name)]
    torn += sorted(scene.before.keys() - found.keys())
    new = scene.after.keys() - scene.before.keys()
    for folder in {name.partition("/")[0] for name in new if "/" in name}:
        expected = {name for name in new if name.startswith(f"{folder}/")}
        if 0 < len(expected & found.keys()) < len(expected):
            torn.append(f"{folder}/ in part")
    return torn


def _versions(scene: Scene, name: str) -> list[bytes]:
    return [files[name] for files in (scene.before, scene.after) if name in files]


def heals(root: Path, scene: Scene) -> bool:
    """Run the command again undisturbed, and tell whether all is as it should be and nothing is left over."""
    is_done = scene.arguments[0] == "submit" and read_files(root) == scene.after
    status = run_quietly(root, scene.arguments)
    is_clean = is_done or count_leftovers(root) == 0  # what is submitted is refused a second time, unwritten
    return status == int(is_done) and read_files(root) == scene.after and is_clean
