"""From a graded submission to its page: headline numbers, all scores, metadata, files and provenance."""

from collections.abc import Iterator

from leaderboard.grading import find_metric
from leaderboard.models import Metadata
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Entry
from leaderboard.website.badges import badge_path, compose_badge, list_snippets, picture_path
from leaderboard.website.calibration_tables import compose_calibrations
from leaderboard.website.citing import cite_submission
from leaderboard.website.comparison_tables import link_comparisons
from leaderboard.website.describing import (
    SUBSET_TITLES,
    badges_of,
    board_path,
    describe_chance,
    submission_path,
    submission_trials_path,
)
from leaderboard.website.disagreements import find_disagreements
from leaderboard.website.forests import draw_scopes
from leaderboard.website.material import Material, Publication
from leaderboard.website.numbers import Footnotes, printer_of, show_interval, unit_of
from leaderboard.website.pages import Fact, Link, SubmissionPage, Tile
from leaderboard.website.pair_figures import draw_pairs
from leaderboard.website.quantities import Described, find_quantity
from leaderboard.website.score_tables import NOT_GRADED, compose_score_tables, list_scopes
from leaderboard.website.standings import describe_gain, describe_standing
from leaderboard.website.trial_figures import draw_agreement, draw_calibrations

PEOPLE_BESIDE: dict[str, tuple[str, Described]] = {"human_r": ("ceiling", find_quantity("ceiling"))}


def compose_scorecard(publication: Publication, material: Material) -> SubmissionPage:
    """Gather what the page of a submission shows."""
    entry = publication.entry
    about = entry.metadata.submission
    standing = material.standings.get(entry.slug)
    board = standing[0] if standing else material.boards[0]
    return SubmissionPage(
        path=submission_path(entry.slug),
        title=about.name,
        summary=about.description,
        slug=entry.slug,
        team=about.team,
        badges=badges_of(entry),
        standing=describe_standing(entry, material),
        gain=describe_gain(entry, material),
        comparisons=link_comparisons(entry.slug, material),
        board=Link(board.track.title, board_path(board)),
        tiles=tuple(_compose_tiles(entry, material)),
        checks=tuple(Fact(check.code, check.message) for check in entry.result.checks),
        drawings=(
            *draw_scopes(entry, material),
            *draw_agreement(entry, material),
            *draw_pairs(entry, material),
        ),
        trials=Link("All trials: which pairs it gets right", submission_trials_path(entry.slug)),
        disagreements=find_disagreements(entry, material),
        tables=compose_score_tables(entry, material),
        diagrams=draw_calibrations(entry, material),
        calibrations=compose_calibrations(entry),
        about=tuple(_list_facts(entry.metadata)),
        downloads=_link_downloads(publication),
        provenance=tuple(_list_provenance(entry, material)),
        history=tuple(_list_history(publication)),
        citation=cite_submission(entry, material),
        badge=compose_badge(entry, material),
        snippets=tuple(list_snippets(entry, material)),
        has_address=bool(material.texts.url),
    )


def _compose_tiles(entry: Entry, material: Material) -> Iterator[Tile]:
    """Choose the headline numbers: overall if there are any, else the accuracy on what is covered."""
    scores = entry.result.scores
    if OVERALL not in scores:
        for scope, title, _ in list_scopes(entry, material.reference.benchmark, "all"):
            if scope in scores:
                yield _compose_tile(entry, material, title, ("accuracy", scope, "all"))
        return
    accuracy = find_metric("accuracy").title
    yield _compose_tile(entry, material, accuracy, ("accuracy", OVERALL, "all"))
    for subset in ("easy", "hard"):
        if subset in scores[OVERALL]:
            title = f"{accuracy}, {SUBSET_TITLES[subset].lower()}"
            yield _compose_tile(entry, material, title, ("accuracy", OVERALL, subset))
    for name in ("human_r", "pair_accuracy") if material.has_pairs else ("human_r",):
        yield _compose_tile(entry, material, find_metric(name).title, (name, OVERALL, "all"))


def _compose_tile(entry: Entry, material: Material, title: str, key: tuple[str, str, str]) -> Tile:
    metric = find_metric(key[0])
    score = entry.score(*key)
    cell = Footnotes().cell(metric, score, absent=NOT_GRADED)
    parts = [_describe_people(material, key)]
    parts.append(f"chance {describe_chance(metric)}" if metric.chance is not None else "")
    below = (cell.why,) if cell.why else tuple(part for part in parts if part)
    return Tile(title, cell, unit_of(metric) if cell.exact else "", below)


def _describe_people(material: Material, key: tuple[str, str, str]) -> str:
    """Print what people reach, or how high their noise lets human r be; nothing where neither is known."""
    metric, scope, subset = key
    word, quantity = PEOPLE_BESIDE.get(metric, ("people", find_metric(metric)))
    score = material.people_score(quantity.name, scope, subset)
    if score is None or score.value is None:
        return ""
    interval = show_interval(quantity, score)
    return f"{word} {printer_of(quantity)(score.value)}" + (f" ({interval})" if interval else "")


def _list_facts(metadata: Metadata) -> Iterator[Fact]:
    about, protocol, model = metadata.submission, metadata.protocol, metadata.model
    yield Fact("Team", about.team)
    yield Fact("System", about.system)
    yield Fact("Date", about.date.isoformat())
    yield Fact("Training", protocol.training.replace("_", " "))
    yield Fact("Testing", protocol.testing.replace("_", " "))
    optional = {
        "Training trials": None if protocol.training_trials is None else f"{protocol.training_trials:,}",
        "Auxiliary": protocol.auxiliary,
        "Selection": protocol.selection,
        "Reader of answers": protocol.answer_reader and f"version {protocol.answer_reader}",
        "Family": model.family,
        "Inputs": model.inputs,
        "Parameters": model.parameters,
        "Pretraining": model.pretraining,
    }
    yield from (Fact(title, text) for title, text in optional.items() if text)
    for title, link in (
        ("Paper", metadata.links.paper),
        ("Code", metadata.links.code),
        ("Weights", metadata.links.weights),
    ):
        if link:
            yield Fact(title, link, target=link)
    github = metadata.contact.github
    yield Fact("Contact", f"@{github}", target=f"https://github.com/{github}")


def _link_downloads(publication: Publication) -> tuple[Link, ...]:
    folder = f"submissions/{publication.entry.slug}"
    own = [
        Link(name, f"{folder}/{name}", _describe_size(len(content)))
        for name, content in publication.files.items()
    ]
    slug = publication.entry.slug
    scores = Link("scores and metadata as JSON", f"api/{folder}.json")
    picture = Link("badge as a picture", picture_path(slug))
    return (*own, scores, picture, Link("badge in the form of shields.io", badge_path(slug)))


def _list_history(publication: Publication) -> Iterator[Fact]:
    """Tell what the public record says of the submission, oldest first."""
    for line in publication.history:
        reason = f": {line.reason}" if line.reason else ""
        yield Fact(line.date.isoformat(), f"{line.event}{reason}")


def _describe_size(n_bytes: int) -> str:
    return f"{n_bytes:,} bytes"


def _list_provenance(entry: Entry, material: Material) -> Iterator[Fact]:
    result = entry.result
    coverage, n_trials = result.coverage, material.reference.n_trials
    yield Fact("Trials", f"{coverage.trials:,} of {n_trials:,} given, {coverage.answered:,} answered")
    yield Fact("Predictions (SHA-256)", result.inputs.predictions_sha256, is_code=True)
    yield Fact("Reference", result.inputs.reference_kind)
    yield Fact("Reference digest", result.inputs.reference_digest, is_code=True)
    yield Fact("Grader", f"{result.grader}, metrics version {result.metrics_version}")
    yield Fact("Grade it again", f"leaderboard grade submissions/{entry.slug}", is_code=True)
