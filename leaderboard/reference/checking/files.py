"""Whether the files of a reference are those that were sealed, and nothing else."""

from collections.abc import Sequence

from leaderboard.errors import SourceError
from leaderboard.instance import MANIFEST_FILE, PUBLISHED_FILE, Instance
from leaderboard.models import Benchmark, Manifest
from leaderboard.problems import Problem, Problems
from leaderboard.reference.cells import quote
from leaderboard.reference.checking.datasheet import Row, Section, make_row
from leaderboard.reference.data import Reference
from leaderboard.reference.definition import sealed_names, shown
from leaderboard.reference.published import read_published

SYNTHETIC_WORD = "synthetic"
SEAL_CODES = ("reference-seal", "reference-manifest")


def check_files(
    reference: Reference, manifest: Manifest | None, seal: Sequence[Problem], strays: Problems
) -> Section:
    """Put together what was found about files; ``manifest`` is None where there is none to believe."""
    rows = []
    if manifest is not None:
        n_changed = len({problem.file for problem in seal})
        found = f"{n_changed} are not" if n_changed else f"all {len(manifest.files)}"
        rows.append(make_row("Files are as sealed", found, expected="all", problems=seal))
    stray = f"{len(strays)}" if strays else "none"
    rows.append(make_row("Files that do not belong", stray, expected="none", problems=strays))
    if manifest is not None:
        rows.append(_check_kind(reference, manifest))
    return Section("Files", tuple(rows))


def find_strays(instance: Instance, benchmark: Benchmark) -> Problems:
    """Find files that are no part of a reference; hidden ones are left alone."""
    problems = Problems()
    known = {*sealed_names(benchmark), MANIFEST_FILE}
    for name in sorted(path.name for path in instance.reference_dir.iterdir()):
        if name not in known and not name.startswith("."):
            message = "is no part of a reference, and is not sealed"
            problems.add("reference-stray-file", message, shown(quote(name)[1:-1]), hint="move it elsewhere")
    return problems


def check_published(instance: Instance, problems: Problems) -> None:
    """Report a file of published numbers that cannot be read; nothing is graded with it."""
    file = instance.reference_file(PUBLISHED_FILE)
    if not file.is_file():
        return
    try:
        read_published(file)
    except SourceError as error:
        line, message = _split_place(error.message.removeprefix(str(file)))
        problems.add("reference-published", message, shown(PUBLISHED_FILE), line=line, hint=error.hint)


def _split_place(text: str) -> tuple[int | None, str]:
    """Split ``:<line>: <message>`` or ``: <message>``."""
    line, separator, message = text.removeprefix(":").partition(": ")
    return (int(line), message) if separator and line.isdecimal() else (None, text.removeprefix(":").strip())


def _check_kind(reference: Reference, manifest: Manifest) -> Row:
    n_named = sum(SYNTHETIC_WORD in trial_id for trial_id in reference.trial_ids)
    n_trials = reference.n_trials
    problems = Problems()
    if n_named != (n_trials if manifest.kind == SYNTHETIC_WORD else 0):
        named = f"{n_named} of {n_trials} trial ids hold the word {SYNTHETIC_WORD}"
        problems.add("reference-kind", f"the kind is {manifest.kind}, but {named}", shown(MANIFEST_FILE))
    expected = "all" if manifest.kind == SYNTHETIC_WORD else "none"
    assumption = f"Trial ids with the word {SYNTHETIC_WORD}"
    return make_row(assumption, f"{n_named} of {n_trials}", expected=expected, problems=problems)
