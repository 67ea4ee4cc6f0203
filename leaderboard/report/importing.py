"""What an import made, as text."""

from leaderboard.reference.recipes import ImportedProperty, ImportReport
from leaderboard.report.problems import render_problems


def render_import(report: ImportReport) -> str:
    """Show the oddities of the official files, then what was imported of each property."""
    width = max(len(p.name) for p in report.properties)
    n_trials = sum(p.n_trials for p in report.properties)
    n_rated = sum(p.n_rated for p in report.properties)
    lines = [
        f"{report.title}: {n_trials:,} trials, {n_rated:,} of them judged by people, in {report.root}",
        *(f"  {p.name:<{width}}  {_describe(p)}" for p in report.properties),
        f"sealed as {report.manifest.kind}, digest {report.manifest.digest}",
    ]
    oddities = render_problems(report.problems, "text") if report.problems else ""
    return oddities + "\n".join(lines) + "\n"


def _describe(property_: ImportedProperty) -> str:
    trials = f"{property_.n_trials:4} trials, {property_.n_rated:4} judged"
    if property_.human_accuracy is None:
        return trials
    return f"{trials}, human accuracy {property_.human_accuracy:.6f}"
