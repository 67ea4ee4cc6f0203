"""Names that identify: trial ids, pair ids and slugs, each with its one rule."""

import re
from collections.abc import Iterable

MAX_ID_LENGTH = 200
SLUG_RULE = "3 to 64 of a-z, 0-9 and -, starting and ending with a letter or digit"

_OPAQUE_ID = re.compile(rf"[!#-&(-~]{{1,{MAX_ID_LENGTH}}}")
_SLUG = re.compile(r"[a-z0-9](?:[a-z0-9-]{1,62}[a-z0-9])")


def is_id(text: str) -> bool:
    """Tell whether a text may be a trial or pair id: printable ASCII, no blanks or quotes, 1 to 200 long.

    >>> is_id("mass-copy0/target=bowl-tscale=0.3,0.5/0001"), is_id("two words"), is_id("")
    (True, False, False)
    """
    return _OPAQUE_ID.fullmatch(text) is not None


def is_slug(text: str) -> bool:
    """Tell whether a text may name a submission's folder.

    >>> is_slug("slot-former-2"), is_slug("-xy"), is_slug("xy"), is_slug("Aloe")
    (True, False, False, False)
    """
    return _SLUG.fullmatch(text) is not None


def format_trial_id(scenario: str, copy: int, config: str, number: str) -> str:
    """Name a trial of a paired benchmark in the released shape.

    >>> format_trial_id("bouncy_wall_pp", 1, "target=cube", "0007")
    'bouncy_wall_pp-copy1/target=cube/0007'
    """
    return f"{scenario}-copy{copy}/{config}/{number}"


def format_pair_id(scenario: str, config: str, number: str) -> str:
    """Name the pair that two such trials make.

    >>> format_pair_id("bouncy_wall_pp", "target=cube", "0007")
    'bouncy_wall_pp/target=cube/0007'
    """
    return f"{scenario}/{config}/{number}"


def find_nearest(text: str, known: Iterable[str]) -> str | None:
    """Return the known name that a mistyped one most resembles, or None if none is close.

    >>> find_nearest("Mas", ["Friction", "Mass"])
    'Mass'
    """
    import difflib  # only mistakes pay for it

    found = difflib.get_close_matches(text[:MAX_ID_LENGTH], known, n=1, cutoff=0.6)
    return found[0] if found else None
