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

MAX_STACKED_MARKS = 4  # above and below one letter; of more, lines overlap their neighbours

_REFUSED_CATEGORIES = {"Cc", "Cf", "Cs", "Co", "Zl", "Zp"}
# What shows nothing though its category is another: Unicode's Default_Ignorable_Code_Point, blank Braille.
_INVISIBLE = (
    *(0x034F, 0x115F, 0x1160, 0x17B4, 0x17B5, *range(0x180B, 0x1810), 0x2065, 0x2800, 0x3164),
    *(*range(0xFE00, 0xFE10), 0xFFA0, *range(0xFFF0, 0xFFF9), *range(0xE0000, 0xE1000)),
)
_NONCHARACTERS = (
    *range(0xFDD0, 0xFDF0),
    *(plane << 16 | end for plane in range(17) for end in (0xFFFE, 0xFFFF)),
)
_REFUSED_CHARACTERS = frozenset(map(chr, (*_INVISIBLE, *_NONCHARACTERS)))


def _check_characters(text: str) -> str:
    n_marks = 0
    for position, character in enumerate(text, 1):
        category = unicodedata.category(character)
        if category in _REFUSED_CATEGORIES or character in _REFUSED_CHARACTERS:
            other = "control character" if category == "Cc" else "character that shows nothing"
            name = unicodedata.name(character, other)
            raise ValueError(f"has U+{ord(character):04X} {name} at position {position}")
        n_marks = n_marks + 1 if category in {"Mn", "Me"} else 0
        if n_marks > MAX_STACKED_MARKS:
            raise ValueError(f"stacks more than {MAX_STACKED_MARKS} marks at position {position}")
    if text != unicodedata.normalize("NFC", text):
        raise ValueError("is not in Unicode's composed form (NFC)")
    return text


def check_not_blank(text: str) -> str:
    """Refuse a text that is empty or has blanks around it."""
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
NameText = Annotated[ShortText, AfterValidator(check_not_blank)]
Link = Annotated[str, Field(max_length=500), AfterValidator(_check_link)]


class About(StrictModel):
    """Who submits what; ``system`` ties together the entries of one model under several protocols."""

    name: NameText
    system: Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9-]{0,62}[a-z0-9]$")]
    team: NameText
    date: dt.date
    description: Text


class Protocol(StrictModel):
    """How the system was trained and tested.

    ``answer_reader`` is the version of the reader of YES and NO that `leaderboard convert` read texts with.
    """

    training: Training
    testing: Testing
    training_trials: int | None = Field(default=None, ge=0, le=1_000_000_000_000)
    auxiliary: Auxiliary | None = None
    selection: Selection | None = None
    answer_reader: int | None = Field(default=None, ge=1, le=1_000_000)


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
    def owner(self) -> tuple[str, str]:
        """Whose it is: the team with its contact, since the team's name alone anybody could write."""
        return self.submission.team, self.contact.github.lower()

    @property
    def is_baseline(self) -> bool:
        """Whether it is a reference line rather than a competitor."""
        return self.model.family == "baseline"
