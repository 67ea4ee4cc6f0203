"""``leaderboard readout``."""

import shlex
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from leaderboard.cli.location import Location

if TYPE_CHECKING:  # start-up: help and usage errors need no NumPy
    from leaderboard.readout.features import Features
    from leaderboard.readout.fitting import Settings
    from leaderboard.readout.pooling import Pooling
    from leaderboard.reference import Reference

PREDICTIONS, METADATA_FILE = "predictions.csv", "metadata.toml"
REPORT, PLOT = "report.json", "reliability.svg"


@click.group("readout")
def command() -> None:
    """Fit the paper's readout to features: predictions, a report and a plot."""


_SHARED = (
    click.option(
        "--fit",
        "fit_files",
        metavar="[PROPERTY=]FILE",
        multiple=True,
        required=True,
        help="Features and labels of the readout's own trials; may be given several times.",
    ),
    click.option(
        "--test",
        "test_files",
        metavar="FILE",
        multiple=True,
        required=True,
        help="Features of the test trials; may be given several times. Labels in it are not read.",
    ),
    click.option(
        "-o",
        "--output",
        metavar="DIR",
        required=True,
        type=click.Path(path_type=Path),
        help=f"New folder for {PREDICTIONS}, {METADATA_FILE}, {REPORT} and {PLOT}.",
    ),
    click.option(
        "--scope",
        type=click.Choice(["property", "all"]),
        default="property",
        show_default=True,
        help="Fit one readout for each property, or one for all.",
    ),
    click.option(
        "--seeds",
        "n_seeds",
        metavar="N",
        type=click.IntRange(1, 100),
        default=3,
        show_default=True,
        help="Average over N ways to deal out folds and to start.",
    ),
)


def _add_options(function: Callable[..., None]) -> Callable[..., None]:
    for option in reversed(_SHARED):
        function = option(function)
    return function


@command.command("fit")
@_add_options
@click.option(
    "--model",
    type=click.Choice(["logistic", "mlp"]),
    default="logistic",
    show_default=True,
    help="Logistic regression, or the appendix's perceptron with 256 and 64 units.",
)
@click.option(
    "--pooling",
    type=click.Choice(["mean", "max", "last", "flatten"]),
    help="What becomes of frames, where features have the shape (trials, frames, features).",
)
@click.pass_obj
def fit(location: Location, /, *, model: str, pooling: "Pooling | None", **options: Any) -> None:  # noqa: ANN401
    """Features to probabilities; everything is chosen on the readout's own trials, pairs never split.

    FILE is .npz, .npy beside a .csv, or .parquet. See docs/readout.md.
    """
    _run(location, model, pooling, **options)


@command.command("distance")
@_add_options
@click.option("--hard", "is_hard", is_flag=True, help="Answer 1 below a learned threshold, and 0 elsewhere.")
@click.pass_obj
def distance(location: Location, /, *, is_hard: bool, **options: Any) -> None:  # noqa: ANN401
    """Distances between two objects to probabilities: the paper's rule for particle models.

    Of all distances of a trial, over frames and pairs of particles, the smallest counts. FILE is as for fit.
    """
    _run(location, "threshold" if is_hard else "distance", "smallest", **options)


def _run(  # noqa: PLR0913  (all options)
    location: Location,
    model: Any,  # noqa: ANN401  (one of outcome.Model)
    pooling: "Pooling | None",
    *,
    fit_files: Sequence[str],
    test_files: Sequence[str],
    output: Path,
    scope: Any,  # noqa: ANN401  (one of matching.Scope)
    n_seeds: int,
) -> None:
    from leaderboard.errors import LeaderboardError
    from leaderboard.readout.fitting import Settings

    if output.exists():
        raise LeaderboardError(f"{output} exists", "choose another folder; nothing is overwritten")
    _, reference = location.load_reference(with_responses=False)
    fitting = [_read(text, reference, pooling, with_labels=True) for text in fit_files]
    test = [_read(text, reference, pooling, with_labels=False) for text in test_files]
    _finish(fitting, test, reference, Settings(model, scope, n_seeds), output)


def _read(text: str, reference: "Reference", pooling: "Pooling | None", *, with_labels: bool) -> "Features":
    from leaderboard.readout.feature_files import read_features

    before, equals, after = text.partition("=")
    names = {name for p in reference.benchmark.properties for name in (p.name, *p.aliases)}
    is_named = with_labels and equals and before in names and not Path(text).exists()
    path = Path(after if is_named else text)
    if not path.is_file():
        if path.exists():
            raise click.UsageError(f"{path} is no file; give the file itself")
        properties = " or ".join(p.name for p in reference.benchmark.properties)
        hint = (
            f"; before an equals sign stands {properties}" if with_labels and equals and not is_named else ""
        )
        raise click.UsageError(f"{path} does not exist{hint}")
    return read_features(
        path, pooling=pooling, property_name=before if is_named else None, with_labels=with_labels
    )


def _finish(
    fitting: "Sequence[Features]",
    test: "Sequence[Features]",
    reference: "Reference",
    settings: "Settings",
    output: Path,
) -> None:
    from leaderboard.files import write_folder
    from leaderboard.readout import (
        METADATA,
        fit_readout,
        render_account,
        render_predictions,
        render_reliability,
        render_report,
    )
    from leaderboard.submitting import render_metadata

    readout = fit_readout(fitting, test, reference, settings)
    contents = {
        PREDICTIONS: render_predictions(readout),
        METADATA_FILE: render_metadata(METADATA),
        REPORT: render_report(readout),
        PLOT: render_reliability(readout),
    }
    write_folder(output, contents)
    click.echo(render_account(readout), err=True, nl=False)
    for name in contents:
        click.echo(f"wrote {output / name}")
    files = shlex.join([str(output / PREDICTIONS), "--metadata", str(output / METADATA_FILE)])
    click.echo(f"  next: leaderboard submit {files} ...", err=True)
