"""The list of pages for search engines, as sitemaps.org has it: addresses alone, and no clock."""

from collections.abc import Sequence
from urllib.parse import quote

from leaderboard.website.rendering import environment

SITEMAP_PATH = "sitemap.xml"
MAX_ENTRIES = 50_000
"""More may not be in one file; boards and submissions come first, so that trials would be left out."""

MISSING_PAGE = "404.html"


def render_sitemap(site: str, paths: Sequence[str]) -> bytes:
    """Render the addresses of pages in order.

    Parameters
    ----------
    site
        Where the site is served, with a slash at the end.
    paths
        Of the pages in the site, those first that matter most; the one for missing pages is left out.
    """
    listed = [path for path in paths if path != MISSING_PAGE][:MAX_ENTRIES]
    addresses = sorted(site + quote(path) for path in listed)
    return environment().get_template(SITEMAP_PATH).render(addresses=addresses).encode()
