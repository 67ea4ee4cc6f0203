"""Building the website: gather everything, then render and write it, the same bytes for the same inputs.

Pages are composed one by one as they are written, since all those of a thousand submissions would fill a
gigabyte. They go to a folder of their own, which takes the earlier site's place when all of it is there.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from leaderboard.files import hold_folder, remove_leftovers
from leaderboard.instance import Instance
from leaderboard.ledger import load_ledger
from leaderboard.reference import load_reference
from leaderboard.website.about_pages import compose_about
from leaderboard.website.badges import render_badges
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
from leaderboard.website.previews import render_preview
from leaderboard.website.property_tables import compose_properties
from leaderboard.website.published_tables import compose_published
from leaderboard.website.rendering import frame_of, logo_path, render_assets, render_feed, render_page
from leaderboard.website.replacing import refuse_other_content, replace_site
from leaderboard.website.schemas import SCHEMA_PATH, render_schema
from leaderboard.website.scorecards import compose_scorecard
from leaderboard.website.sitemaps import SITEMAP_PATH, render_sitemap
from leaderboard.website.stamps import digest_inputs, is_current
from leaderboard.website.status_pages import compose_status
from leaderboard.website.submit_pages import compose_submit
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

    Where the folder holds what these inputs gave before, it stays as it is. A build waits until another of
    the same instance has ended.

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
    with hold_folder(instance.root):
        remove_leftovers(instance.site_dir)
        return _build(instance, folder, commit)


def _build(instance: Instance, folder: Path, commit: str) -> SiteReport:
    inputs = digest_inputs(instance, folder, commit)
    if is_current(folder, inputs):
        return SiteReport(folder, _count_pages(folder), was_current=True)
    reference = load_reference(instance)
    publications = load_publications(instance, reference)
    published, texts = load_published(instance), load_texts(instance)
    material = gather(reference, publications, published, texts, record=load_ledger(instance).lines)
    replace_site(folder, render_site(material, compose_pages(material), commit), inputs)
    return SiteReport(folder, _count_pages(folder))


def _count_pages(folder: Path) -> int:
    return sum(1 for _ in folder.rglob("*.html"))


def compose_pages(material: Material) -> Iterator[tuple[str, Page]]:
    """Gather every page, each with the template that prints it, one after the other."""
    for board in material.boards:
        parts = split_board(compose_board(board, material), board.track.id)
        yield from (("board.html", part) for part in parts)
    yield from (("figure.html", compose_figure(board, material)) for board in material.boards)
    yield from (("submission.html", compose_scorecard(p, material)) for p in material.publications)
    yield from (("property.html", page) for page in compose_properties(material))
    yield "grid.html", compose_trials(material)
    yield from (("grid.html", page) for page in compose_submission_trials(material))
    yield from (("trials.html", page) for page in compose_trial_lists(material))
    yield from (("trial.html", page) for page in compose_trial_pages(material))
    yield from (("comparison.html", page) for page in compose_comparison_pages(material))
    if len(material.publications) > 1:
        yield "comparisons.html", compose_comparisons(material)
    yield "people.html", compose_people(material)
    yield "method.html", compose_method(material)
    yield "published.html", compose_published(material)
    yield "data.html", compose_data(material)
    yield "about.html", compose_about(material)
    yield "submit.html", compose_submit(material)
    yield "status.html", compose_status(material)
    yield "404.html", Page("404.html", "Page not found", "There is nothing under this address.")


def render_site(
    material: Material, pages: Iterable[tuple[str, Page]], commit: str = ""
) -> Iterator[tuple[str, bytes]]:
    """Render every file of the site as its path and its bytes, one after the other."""
    frame = frame_of(material.reference, commit, material.texts)
    yield ".nojekyll", b""
    yield from render_assets().items()
    if material.texts.logo:
        yield logo_path(material.texts.logo), material.texts.logo.content
    paths = []
    for template, page in pages:
        paths.append(page.path)
        yield page.path, render_page(template, frame, page)
        yield from ((file.path, file.content) for file in page.data_files)
        yield from render_figures(frame, [page])
    yield from render_exports(material)
    yield SCHEMA_PATH, render_schema()
    yield from render_badges(material)
    yield "feed.xml", render_feed(compose_feed(material))
    if frame.site:
        yield SITEMAP_PATH, render_sitemap(frame.site, paths)
        yield frame.preview, render_preview(material, frame)
    for publication in material.publications:
        for name, content in publication.files.items():
            yield f"submissions/{publication.entry.slug}/{name}", content
