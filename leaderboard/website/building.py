"""Building the website: gather everything, then render and write it, the same bytes for the same inputs."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from leaderboard.files import remove_leftovers
from leaderboard.instance import Instance
from leaderboard.reference import load_reference
from leaderboard.website.about_pages import compose_about
from leaderboard.website.badges import render_badges
from leaderboard.website.board_pages import BoardPage
from leaderboard.website.board_parts import split_board
from leaderboard.website.boards import compose_board
from leaderboard.website.comparison_tables import compose_comparison_pages, compose_comparisons
from leaderboard.website.datasheets import compose_data
from leaderboard.website.exports import render_exports
from leaderboard.website.feeds import compose_feed
from leaderboard.website.figure_exports import render_figures
from leaderboard.website.material import Material, gather, load_publications, load_published
from leaderboard.website.methods import compose_method
from leaderboard.website.pages import Page
from leaderboard.website.paper_figures import compose_figure
from leaderboard.website.people_pages import compose_people
from leaderboard.website.property_tables import compose_properties
from leaderboard.website.published_tables import compose_published
from leaderboard.website.rendering import frame_of, render_assets, render_feed, render_page
from leaderboard.website.replacing import refuse_other_content, replace_site
from leaderboard.website.scorecards import compose_scorecard
from leaderboard.website.stamps import digest_inputs, is_current
from leaderboard.website.texts import load_texts
from leaderboard.website.trial_cards import compose_trial_pages
from leaderboard.website.trial_grids import compose_submission_trials, compose_trials
from leaderboard.website.trial_tables import compose_trial_lists


@dataclass(frozen=True)
class SiteReport:
    """Where the site is, how many pages it has, and whether they were there already, byte for byte."""

    path: Path
    n_pages: int
    was_current: bool = False


def build_site(instance: Instance, out: Path | None = None, *, commit: str = "") -> SiteReport:
    """Build the website of an instance into a folder, in place of an earlier one.

    Where the folder holds what these inputs gave before, it stays as it is.

    Parameters
    ----------
    out
        The folder; ``site/dist`` of the instance without it.
    commit
        Id of the commit that is published, for the footer; empty if it is not said.

    Raises
    ------
    BrokenReferenceError
        If the reference cannot be used.
    SourceError
        If the published numbers cannot be read.
    InstanceError
        If a submission is not graded, a text of the site cannot be read, or the folder holds something that
        is no earlier site.
    """
    folder = out or instance.dist_dir
    refuse_other_content(folder)
    remove_leftovers(instance.site_dir)
    inputs = digest_inputs(instance, folder, commit)
    if is_current(folder, inputs):
        return SiteReport(folder, sum(1 for _ in folder.rglob("*.html")), was_current=True)
    reference = load_reference(instance)
    publications = load_publications(instance, reference)
    material = gather(reference, publications, load_published(instance), load_texts(instance))
    pages = compose_pages(material)
    replace_site(folder, render_site(material, pages, commit), inputs)
    return SiteReport(folder, len(pages))


def compose_pages(material: Material) -> list[tuple[str, Page]]:
    """Gather every page, each with the template that prints it."""
    pages: list[tuple[str, Page]] = []
    for board in material.boards:
        parts = split_board(compose_board(board, material), board.track.id)
        pages += [("board.html", part) for part in parts]
    pages += [("figure.html", compose_figure(board, material)) for board in material.boards]
    pages += [("submission.html", compose_scorecard(p, material)) for p in material.publications]
    pages += [("property.html", page) for page in compose_properties(material)]
    pages.append(("grid.html", compose_trials(material)))
    pages += [("grid.html", page) for page in compose_submission_trials(material)]
    pages += [("trials.html", page) for page in compose_trial_lists(material)]
    pages += [("trial.html", page) for page in compose_trial_pages(material)]
    pages += [("comparison.html", page) for page in compose_comparison_pages(material)]
    if material.comparisons:
        pages.append(("comparisons.html", compose_comparisons(material)))
    pages.append(("people.html", compose_people(material)))
    pages.append(("method.html", compose_method(material)))
    pages.append(("published.html", compose_published(material)))
    pages.append(("data.html", compose_data(material)))
    pages.append(("about.html", compose_about(material)))
    pages.append(("404.html", Page("404.html", "Page not found", "There is nothing under this address.")))
    return pages


def render_site(
    material: Material, pages: list[tuple[str, Page]], commit: str = ""
) -> Iterator[tuple[str, bytes]]:
    """Render every file of the site as its path and its bytes, one after the other."""
    frame = frame_of(material.reference, commit)
    yield ".nojekyll", b""
    yield from render_assets().items()
    for template, page in pages:
        yield page.path, render_page(template, frame, page)
        if isinstance(page, BoardPage) and page.rest:
            yield page.rest.path, page.rest.content
    yield from render_exports(material)
    yield from render_badges(material)
    yield from render_figures(frame, [page for _, page in pages])
    yield "feed.xml", render_feed(compose_feed(material))
    for publication in material.publications:
        for name, content in publication.files.items():
            yield f"submissions/{publication.entry.slug}/{name}", content
