"""Showing what a participant wrote, so that a message stays one short printable line."""

from leaderboard.reference.cells import quote

MAX_QUOTED = 80


def quote_briefly(text: str, limit: int = MAX_QUOTED) -> str:
    r"""Quote and escape a text; of one that would take more than ``limit`` characters, both ends.

    The end of a trial id is what tells it from its neighbours.

    >>> print(quote_briefly("tab\there"), quote_briefly("a-long-name/0001", 10))
    'tab\there' 'a-lon...01'
    """
    if len(text) <= limit and len(quote(text)) <= limit + 2:
        return quote(text)
    ends = (
        quote(f"{text[: size - size // 3]}...{text[len(text) - size // 3 :]}") for size in range(limit, 0, -1)
    )
    return next(shown for shown in ends if len(shown) <= limit + 2)
