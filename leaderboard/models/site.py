"""What maintainers set for their site (``site.toml``)."""

import re
from typing import Annotated

from pydantic import AfterValidator

from leaderboard.models.metadata import NameText
from leaderboard.models.strict import StrictModel

_URL = re.compile(r"https?://[A-Za-z0-9.-]*[A-Za-z0-9](:[0-9]+)?(/[A-Za-z0-9_~%-][A-Za-z0-9._~%-]*)*/")
_LOGO = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]*\.(svg|png)")


def _check_url(text: str) -> str:
    if not _URL.fullmatch(text):
        raise ValueError("must be an address with a slash at the end, such as https://example.org/board/")
    return text


def _check_logo(text: str) -> str:
    if not _LOGO.fullmatch(text):
        raise ValueError("must be the name of an .svg or .png file in site/content/, such as logo.svg")
    return text


class SiteSettings(StrictModel):
    """The whole of ``site.toml``; everything may be left out.

    Attributes
    ----------
    title
        The name of the site; without it, that of the benchmark.
    url
        Where the site is served, with a slash at the end.
    logo
        The name of a picture in ``site/content/``.
    """

    title: NameText | None = None
    url: Annotated[str, AfterValidator(_check_url)] | None = None
    logo: Annotated[str, AfterValidator(_check_logo)] | None = None
