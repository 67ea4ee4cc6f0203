"""From gathered pages to bytes: Jinja templates that escape everything, and files with hashed names."""

from functools import cache
from importlib.resources import files

from jinja2 import Environment, PackageLoader, StrictUndefined

from leaderboard import __version__
from leaderboard.files import sha256_hex
from leaderboard.grading import METRICS_VERSION
from leaderboard.reference import Reference
from leaderboard.website.pages import Feed, Frame, Page

STYLESHEET = "site.css"
ICON = "icon.svg"
N_HASH_DIGITS = 10


def render_page(template: str, frame: Frame, page: Page) -> bytes:
    """Render a page within the frame that all pages share."""
    return environment().get_template(template).render(frame=frame, page=page).encode()


def render_feed(feed: Feed) -> bytes:
    """Render the feed as Atom."""
    return environment().get_template("feed.xml").render(feed=feed).encode()


def frame_of(reference: Reference) -> Frame:
    """Gather what surrounds every page."""
    benchmark, manifest = reference.benchmark, reference.manifest
    return Frame(
        title=f"{benchmark.title} leaderboard",
        is_synthetic=reference.is_synthetic,
        benchmark=f"{benchmark.title} {benchmark.version}",
        reference_kind=manifest.kind,
        reference_digest=manifest.digest,
        grader=__version__,
        metrics_version=METRICS_VERSION,
        stylesheet=asset_path(STYLESHEET),
        icon=asset_path(ICON),
    )


def render_assets() -> dict[str, bytes]:
    """Map the paths of style and icon in the site to their bytes."""
    return {asset_path(name): _read_asset(name) for name in (STYLESHEET, ICON)}


def asset_path(name: str) -> str:
    """Name an asset after its content, so that a browser never shows a new page with an old style."""
    stem, dot, extension = name.rpartition(".")
    return f"assets/{stem}.{sha256_hex(_read_asset(name))[:N_HASH_DIGITS]}{dot}{extension}"


@cache
def environment() -> Environment:
    """The one Jinja environment: it escapes in every template and refuses names that are not there."""
    return Environment(
        loader=PackageLoader("leaderboard.website"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )


@cache
def _read_asset(name: str) -> bytes:
    return (files("leaderboard.website") / "static" / name).read_bytes()
