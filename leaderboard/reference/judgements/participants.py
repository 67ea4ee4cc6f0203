"""Making people anonymous: opaque ids instead of those of recruiting services, and messages without ids."""

import re
from collections.abc import Iterable

from leaderboard.files import sha256_hex
from leaderboard.reference.cells import quote

# Part of what orders participants; another one would rename everybody.
_SALT = "participants of an imported reference\n"
_MIN_WIDTH = 3
_MIN_DISTINCTIVE = 5  # shorter ids are parts of all kinds of words
_PLAIN_WORD = re.compile(r"[A-Za-z ]{1,20}|[0-9.]{1,4}")


def rename_participants(raw_ids: Iterable[str]) -> dict[str, str]:
    """Give each person an opaque id, in an order that depends on nothing but the set of raw ids.

    The order is that of salted checksums, so that it tells neither when somebody took part nor how the
    raw ids sort.

    Parameters
    ----------
    raw_ids
        As files have them; repetitions do not matter.

    Examples
    --------
    >>> rename_participants(["60aa", "5f1c", "60aa"])
    {'5f1c': 'p001', '60aa': 'p002'}
    """
    ordered = sorted(set(raw_ids), key=lambda raw_id: (sha256_hex((_SALT + raw_id).encode()), raw_id))
    width = max(_MIN_WIDTH, len(str(len(ordered))))
    return {raw_id: f"p{number:0{width}}" for number, raw_id in enumerate(ordered, 1)}


class Discretion:
    """Quotes cells in messages only where they cannot tell who somebody is.

    Parameters
    ----------
    raw_ids
        Everything in a file that may identify a person.
    """

    def __init__(self, raw_ids: Iterable[str]) -> None:
        self._raw_ids = {raw_id.strip() for raw_id in raw_ids} - {""}
        self._distinctive = [raw_id for raw_id in self._raw_ids if len(raw_id) >= _MIN_DISTINCTIVE]

    def quote_name(self, text: str) -> str | None:
        """Quote a name of a trial; None if it is or holds a person's id."""
        is_person = text.strip() in self._raw_ids or any(raw_id in text for raw_id in self._distinctive)
        return None if is_person else quote(text)

    def quote_word(self, text: str) -> str | None:
        """Quote an answer if it is a plain word or a small number; None if not, or if it is a person's id."""
        return self.quote_name(text) if _PLAIN_WORD.fullmatch(text.strip()) else None
