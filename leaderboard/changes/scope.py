"""Which submission a branch changes, and whether it touches anything else."""

from collections.abc import Iterable, Sequence

from leaderboard.problems import Problems
from leaderboard.validation.quoting import quote_briefly

MAX_NAMED = 5


def find_slug(paths: Sequence[str], submissions: str, problems: Problems) -> str | None:
    """Name the one submission that a branch changes; None, and problems, if it is not exactly one.

    Parameters
    ----------
    paths
        The paths that differ, within the repository.
    submissions
        Path of the folder of submissions, with a slash at the end.
    problems
        Receives every path that no submission may touch.
    """
    if not paths:
        problems.add("change-nothing", "the two commits do not differ", ".")
    inside: dict[str, None] = {}
    for path in paths:
        slug, _, name = path.removeprefix(submissions).partition("/")
        if path.startswith(submissions) and slug and name:
            inside[slug] = None
        else:
            hint = "a submission touches nothing but its own folder; send other changes on their own"
            message = f"this changes {quote_briefly(path)} too"
            problems.add("change-outside", message, _shown(path), hint=hint)
    if len(inside) > 1:
        hint = "send one pull request for each submission"
        message = f"{len(inside)} submissions change: {_list(sorted(inside))}"
        problems.add("change-several", message, submissions, hint=hint)
    return next(iter(inside)) if len(inside) == 1 else None


def _list(slugs: Sequence[str]) -> str:
    named: Iterable[str] = (quote_briefly(slug) for slug in slugs[:MAX_NAMED])
    return ", ".join(named) + (", ..." if len(slugs) > MAX_NAMED else "")


def _shown(path: str) -> str:
    return path if path.isascii() and path.isprintable() else ascii(path)[1:-1]
