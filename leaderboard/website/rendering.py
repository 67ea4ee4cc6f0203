"""From gathered pages to bytes: Jinja templates that escape everything, and files with hashed names."""

from functools import cache
from importlib.resources import files
from pathlib import PurePosixPath

from jinja2 import Environment, PackageLoader, StrictUndefined

from leaderboard import __version__
from leaderboard.files import sha256_hex
from leaderboard.grading import METRICS_VERSION
from leaderboard.reference import Reference
from leaderboard.website.describing import property_path
from leaderboard.website.escaping import EscapingEnvironment
from leaderboard.website.feed_items import Feed
from leaderboard.website.pages import Frame, Page
from leaderboard.website.texts import NO_TEXTS, Logo, Texts

STYLESHEET = "site.css"
ICON = "icon.svg"
SCRIPTS = ("vendor/datatables.js", "site.js")
COMPARER = "compare.js"
PREVIEW_PATH = "preview.png"
LICENSES = ("vendor/datatables-license.txt",)
N_HASH_DIGITS = 10
N_COMMIT_DIGITS = 12


def render_page(template: str, frame: Frame, page: Page) -> bytes:
    """Render a page within the frame that all pages share."""
    return environment().get_template(template).render(frame=frame, page=page).encode()


def render_feed(feed: Feed) -> bytes:
    """Render the feed as Atom."""
    return environment().get_template("feed.xml").render(feed=feed).encode()


def frame_of(reference: Reference, commit: str = "", texts: Texts = NO_TEXTS) -> Frame:
    """Gather what surrounds every page; the commit is empty if it is not known."""
    benchmark, manifest = reference.benchmark, reference.manifest
    return Frame(
        title=texts.title or f"{benchmark.title} leaderboard",
        properties=property_path(benchmark.properties[0].name),
        is_synthetic=reference.is_synthetic,
        benchmark=f"{benchmark.title} {benchmark.version}",
        reference_kind=manifest.kind,
        reference_digest=manifest.digest,
        commit=commit[:N_COMMIT_DIGITS],
        grader=__version__,
        metrics_version=METRICS_VERSION,
        stylesheet=asset_path(STYLESHEET),
        icon=asset_path(ICON),
        logo=logo_path(texts.logo) if texts.logo else "",
        site=texts.url,
        preview=PREVIEW_PATH,
        scripts=tuple(asset_path(name) for name in SCRIPTS),
        comparer=asset_path(COMPARER),
    )


def render_assets() -> dict[str, bytes]:
    """Map the paths of style, icon, scripts and their licenses in the site to their bytes."""
    return {asset_path(name): _read_asset(name) for name in (STYLESHEET, ICON, *SCRIPTS, COMPARER, *LICENSES)}


def asset_path(name: str) -> str:
    """Name an asset after its content, so that a browser never shows a new page with an old style."""
    return _name_asset(PurePosixPath(name), _read_asset(name))


def logo_path(logo: Logo) -> str:
    """Name the picture beside the title in the same way."""
    return _name_asset(PurePosixPath(logo.name), logo.content)


def _name_asset(file: PurePosixPath, content: bytes) -> str:
    return f"assets/{file.stem}.{sha256_hex(content)[:N_HASH_DIGITS]}{file.suffix}"


@cache
def environment() -> Environment:
    """The one Jinja environment: it escapes in every template and refuses names that are not there."""
    return EscapingEnvironment(
        loader=PackageLoader("leaderboard.website"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )


@cache
def _read_asset(name: str) -> bytes:
    return (files("leaderboard.website") / "static" / name).read_bytes()
