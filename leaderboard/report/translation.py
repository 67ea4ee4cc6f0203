"""What was translated from other names to trial ids, as text."""

from collections.abc import Sequence

from leaderboard.validation.quoting import quote_briefly
from leaderboard.validation.translating import TranslatedName


def render_translations(names: Sequence[TranslatedName]) -> str:
    """Say in one line how many names were translated, with the first as an example; empty if none were.

    >>> print(render_translations([TranslatedName("ramp_1.mp4", "ramp_1")]))
    1 name was translated to its trial id: 'ramp_1.mp4' -> ramp_1
    """
    if not names:
        return ""
    example = f"{quote_briefly(names[0].name)} -> {names[0].trial_id}"
    if len(names) == 1:
        return f"1 name was translated to its trial id: {example}"
    return f"{len(names):,} names were translated to trial ids, for instance {example}"
