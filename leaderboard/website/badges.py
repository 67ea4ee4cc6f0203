"""Badges: rank and accuracy of a submission as a picture, and in the form that shields.io reads."""

from collections.abc import Iterator

from leaderboard.files import canonical_json
from leaderboard.grading import find_metric
from leaderboard.ranking import Entry
from leaderboard.website.describing import submission_path
from leaderboard.website.figures.lettering import estimate_width
from leaderboard.website.material import Material
from leaderboard.website.numbers import show_percent
from leaderboard.website.pages import Badge, Fact
from leaderboard.website.rendering import environment

SCHEMA_VERSION = 1
RANKED, NOT_RANKED, SYNTHETIC = "blue", "lightgrey", "yellow"
BACKS = {RANKED: "#1a4fb4", NOT_RANKED: "#5a6068", SYNTHETIC: "#7a5c00"}
LETTER_SIZE, PADDING = 11, 6
ENDPOINT = "https://img.shields.io/endpoint?url="
ADDRESS = "ADDRESS-OF-THIS-SITE"
"""Stands for where the site is served, where the site itself does not know it."""


def badge_path(slug: str) -> str:
    """Say where the badge of a submission is."""
    return f"badge/{slug}.json"


def picture_path(slug: str) -> str:
    """Say where the badge of a submission is as a picture."""
    return f"badge/{slug}.svg"


def compose_badge(entry: Entry, material: Material) -> Badge:
    """Lay out the badge of a submission."""
    data = badge_data(entry, material)
    label, message = str(data["label"]), str(data["message"])
    return Badge(label, message, _measure(label), _measure(message), BACKS[str(data["color"])])


def _measure(words: str) -> float:
    return round(estimate_width(words, LETTER_SIZE) + 2 * PADDING)


def list_snippets(entry: Entry, material: Material) -> Iterator[Fact]:
    """Write what shows the badge elsewhere; an unknown address is for its reader to put in."""
    slug, title = entry.slug, material.reference.benchmark.title
    site = material.texts.url or f"{ADDRESS}/"
    page = f"{site}{submission_path(slug)}"
    yield Fact("Markdown", f"[![{title}]({site}{picture_path(slug)})]({page})", is_code=True)
    picture = f'<img src="{site}{picture_path(slug)}" alt="{title}">'
    yield Fact("HTML", f'<a href="{page}">{picture}</a>', is_code=True)
    yield Fact("shields.io", f"![{title}]({ENDPOINT}{site}{badge_path(slug)})", is_code=True)


def render_badges(material: Material) -> Iterator[tuple[str, bytes]]:
    """Render the badges of all submissions as their paths in the site and their bytes."""
    template = environment().get_template("badge.svg")
    for entry in (publication.entry for publication in material.publications):
        yield badge_path(entry.slug), canonical_json(badge_data(entry, material)).encode()
        yield picture_path(entry.slug), template.render(badge=compose_badge(entry, material)).encode()


def badge_data(entry: Entry, material: Material) -> dict[str, object]:
    """Lay out a badge; it is shown far from the site, so it says itself if the reference is simulated."""
    _, row = material.standings.get(entry.slug, (None, None))
    rank = row.rank if row else None
    is_synthetic = material.reference.is_synthetic
    color = NOT_RANKED if rank is None else RANKED
    return {
        "schemaVersion": SCHEMA_VERSION,
        "label": material.reference.benchmark.title + (" (synthetic)" if is_synthetic else ""),
        "message": ", ".join([_name_place(entry, rank), *_show_accuracy(entry)]),
        "color": SYNTHETIC if is_synthetic else color,
    }


def _name_place(entry: Entry, rank: int | None) -> str:
    if rank is not None:
        return f"rank {rank}"
    if entry.is_baseline:
        return "baseline"
    return "not ranked" if entry.is_complete else "partial"


def _show_accuracy(entry: Entry) -> Iterator[str]:
    """Print the overall accuracy, which partial submissions have not."""
    score = entry.score(find_metric("accuracy").name)
    if score is not None and score.value is not None:
        yield f"{show_percent(score.value)} %"
