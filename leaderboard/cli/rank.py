"""``leaderboard rank``."""

import click

from leaderboard.cli.location import Location, current_terminal
from leaderboard.errors import LeaderboardError
from leaderboard.grading import Yardstick, grade_people
from leaderboard.models import Benchmark, Track
from leaderboard.ranking import load_entries, rank_entries
from leaderboard.report.board import render_board, render_board_csv, render_board_json
from leaderboard.report.latex import render_board_latex


@click.command("rank")
@click.option("--track", "track_id", help="Which board; without it, the default track's.")
@click.option("--metric", default="accuracy", show_default=True, help="Order by this metric's overall value.")
@click.option("--csv", "format_", flag_value="csv", help="Print CSV with full precision.")
@click.option("--latex", "format_", flag_value="latex", help="Print a LaTeX table with booktabs rules.")
@click.option("--json", "format_", flag_value="json", help="Print all scores of all rows as JSON.")
@click.pass_obj
def command(location: Location, track_id: str | None, metric: str, format_: str | None) -> None:
    """Print the board of a track: people, ranked and partial submissions, baselines."""
    instance, reference = location.load_reference()
    track = _choose_track(reference.benchmark, track_id)
    yardstick = Yardstick.of(reference)
    board = rank_entries(load_entries(instance, reference), track, metric, yardstick=yardstick)
    people = grade_people(reference, yardstick=yardstick)
    if format_ is None:
        click.echo(render_board(board, reference, people, terminal=current_terminal()), nl=False)
    else:
        render = {"csv": render_board_csv, "latex": render_board_latex, "json": render_board_json}[format_]
        click.echo(render(board, reference, people), nl=False)


def _choose_track(benchmark: Benchmark, track_id: str | None) -> Track:
    if track_id is None:
        return benchmark.default_track
    tracks = {track.id: track for track in benchmark.tracks}
    if track_id not in tracks:
        raise LeaderboardError(f"there is no track {track_id!r}", f"choose one of {', '.join(tracks)}")
    return tracks[track_id]
