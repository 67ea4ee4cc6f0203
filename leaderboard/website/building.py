"""Building the website: gather everything, then render and write it, the same bytes for the same inputs."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from leaderboard.instance import Instance
from leaderboard.reference import load_reference
from leaderboard.website.boards import compose_board
from leaderboard.website.exports import render_exports
from leaderboard.website.feeds import compose_feed
from leaderboard.website.material import Material, gather, load_publications
from leaderboard.website.methods import compose_method
from leaderboard.website.pages import Page
from leaderboard.website.rendering import frame_of, render_assets, render_feed, render_page
from leaderboard.website.replacing import refuse_other_content, replace_site
from leaderboard.website.scorecards import compose_scorecard


@dataclass(frozen=True)
class SiteReport:
    """Where the site is and how many pages it has."""

    path: Path
    n_pages: int


def build_site(instance: Instance, out: Path | None = None) -> SiteReport:
    """Build the website of an instance into a folder, in place of an earlier one.

    Parameters
    ----------
    out
        The folder; ``site/dist`` of the instance without it.

    Raises
    ------
    BrokenReferenceError
        If the reference cannot be used.
    InstanceError
        If a submission is not graded, or the folder holds something that is no earlier site.
    """
    folder = out or instance.dist_dir
    refuse_other_content(folder)
    reference = load_reference(instance)
    material = gather(reference, load_publications(instance, reference))
    pages = compose_pages(material)
    replace_site(folder, render_site(material, pages))
    return SiteReport(folder, len(pages))


def compose_pages(material: Material) -> list[tuple[str, Page]]:
    """Gather every page, each with the template that prints it."""
    pages: list[tuple[str, Page]] = []
    pages += [("board.html", compose_board(board, material)) for board in material.boards]
    pages += [("submission.html", compose_scorecard(p, material)) for p in material.publications]
    pages.append(("method.html", compose_method(material)))
    pages.append(("404.html", Page("404.html", "Page not found", "There is nothing under this address.")))
    return pages


def render_site(material: Material, pages: list[tuple[str, Page]]) -> Iterator[tuple[str, bytes]]:
    """Render every file of the site as its path and its bytes, one after the other."""
    frame = frame_of(material.reference)
    yield ".nojekyll", b""
    yield from render_assets().items()
    for template, page in pages:
        yield page.path, render_page(template, frame, page)
    yield from render_exports(material)
    yield "feed.xml", render_feed(compose_feed(material))
    for publication in material.publications:
        for name, content in publication.files.items():
            yield f"submissions/{publication.entry.slug}/{name}", content
