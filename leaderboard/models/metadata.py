"""What a submission says of itself (``submission.toml``)."""

import datetime as dt
import unicodedata
from typing import Annotated, Literal
from urllib.parse import urlsplit

from pydantic import AfterValidator, Field

from leaderboard.models.strict import StrictModel

Training = Literal["separate", "unified", "zero_shot"]
Testing = Literal["with_property", "without_property", "fully_observed"]
Auxiliary = Literal["implicit", "explicit"]
Selection = Literal["readout", "test", "none"]
Inputs = Literal["rgb", "rgb+masks", "state"]
Family = Literal[
    "video", "image-encoder", "object-centric", "particle", "vlm", "world-model", "baseline", "other"
]

MAX_NAME_LENGTH = 80
MAX_TEXT_LENGTH = 1000

_REFUSED_CATEGORIES = {"Cc", "Cf", "Cs", "Co", "Zl", "Zp"}


def _check_characters(text: str) -> str:
    for position, character in enumerate(text, 1):
        if unicodedata.category(character) in _REFUSED_CATEGORIES:
            name = unicodedata.name(character, "control character")
            raise ValueError(f"has U+{ord(character):04X} {name} at position {position}")
    if text != unicodedata.normalize("NFC", text):
        raise ValueError("is not in Unicode's composed form (NFC)")
    return text


def _check_not_blank(text: str) -> str:
    if not text or text != text.strip():
        raise ValueError("must not be empty, nor start or end with a blank")
    return text


def _check_link(link: str) -> str:
    try:
        parts = urlsplit(link)
    except ValueError:
        raise ValueError("is not a link") from None
    if parts.scheme not in ("http", "https") or not parts.hostname:
        raise ValueError("must start with https:// or http:// and name a host")
    if "@" in parts.netloc:
        raise ValueError("must not hold a user name or password")
    if not link.isascii() or any(character in link for character in " \"'<>\\`{}|^"):
        raise ValueError("has characters that a link must write as %XX")
    return link


Text = Annotated[str, Field(max_length=MAX_TEXT_LENGTH), AfterValidator(_check_characters)]
ShortText = Annotated[str, Field(max_length=MAX_NAME_LENGTH), AfterValidator(_check_characters)]
NameText = Annotated[ShortText, AfterValidator(_check_not_blank)]
Link = Annotated[str, Field(max_length=500), AfterValidator(_check_link)]


class About(StrictModel):
    """Who submits what; ``system`` ties together the entries of one model under several protocols."""

    name: NameText
    system: Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9-]{0,62}[a-z0-9]$")]
    team: NameText
    date: dt.date
    description: Text


class Protocol(StrictModel):
    """How the system was trained and tested."""

    training: Training
    testing: Testing
    training_trials: int | None = Field(default=None, ge=0, le=1_000_000_000_000)
    auxiliary: Auxiliary | None = None
    selection: Selection | None = None


class System(StrictModel):
    """What kind of model it is."""

    family: Family
    inputs: Inputs
    parameters: ShortText | None = None
    pretraining: ShortText | None = None


class Links(StrictModel):
    """Where to read more."""

    paper: Link | None = None
    code: Link | None = None
    weights: Link | None = None


class Contact(StrictModel):
    """Whom to ask."""

    github: Annotated[str, Field(pattern=r"^[A-Za-z0-9]+(-[A-Za-z0-9]+)*$", max_length=39)]


class Metadata(StrictModel):
    """The whole of ``submission.toml``."""

    submission: About
    protocol: Protocol
    model: System
    links: Links = Field(default_factory=Links)
    contact: Contact

    @property
    def is_baseline(self) -> bool:
        """Whether it is a reference line rather than a competitor."""
        return self.model.family == "baseline"
