"""What does not fit a model of a file, in words."""

from collections.abc import Iterable, Iterator

from pydantic import ValidationError

_PLAIN_WORDS = {"missing": "is missing", "extra_forbidden": "is not a known key"}


def describe_faults(error: ValidationError) -> Iterator[str]:
    """Say of each fault where it is and what it is: ``tracks[2].title: is missing``."""
    for fault in error.errors(include_url=False, include_context=False):
        where = _render_place(fault["loc"])
        what = _PLAIN_WORDS.get(fault["type"], fault["msg"].removeprefix("Value error, "))
        yield f"{where}: {what}" if where else what


def _render_place(parts: Iterable[int | str]) -> str:
    """Write a place in a model as a person would: ``tracks[2].title``, counting from 1."""
    place = ""
    for part in parts:
        place += f"[{part + 1}]" if isinstance(part, int) else f".{part}" if place else str(part)
    return place
