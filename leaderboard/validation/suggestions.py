"""What an unknown trial id was probably meant to be."""

import re
import unicodedata
from bisect import bisect_left
from collections import Counter
from collections.abc import Callable, Sequence
from functools import cached_property

from leaderboard.ids import find_nearest
from leaderboard.trial_names import Ambiguous, Resolved, TrialNames

NEIGHBOURS = 6


class Suggestions:
    """Explains unknown ids; indexes are made when first needed.

    Parameters
    ----------
    trial_ids
        The real ones.
    """

    def __init__(self, trial_ids: Sequence[str]) -> None:
        self._trial_ids = trial_ids

    @cached_property
    def _exact(self) -> frozenset[str]:
        return frozenset(self._trial_ids)

    @cached_property
    def _names(self) -> TrialNames:
        return TrialNames(self._trial_ids)

    @cached_property
    def _folded(self) -> dict[str, str]:
        """The ids that stay apart without capitals, by that form."""
        return _key_uniquely(self._trial_ids, str.casefold)

    @cached_property
    def _unpadded(self) -> dict[str, str]:
        """The ids that stay apart without leading zeros, by that form."""
        return _key_uniquely(self._trial_ids, _strip_zeros)

    @cached_property
    def _forward(self) -> list[str]:
        return sorted(self._trial_ids)

    @cached_property
    def _backward(self) -> list[str]:
        return sorted(trial_id[::-1] for trial_id in self._trial_ids)

    def explain(self, text: str) -> str:
        """Say how the id departs from a real one, or name the nearest; empty if nothing is near."""
        return self._explain_spelling(text) or self._explain_alias(text) or self._name_nearest(text)

    def _explain_spelling(self, text: str) -> str:
        """Recognise an id with other blanks, capitals or leading zeros."""
        tidy = text.strip()
        if tidy in self._exact:
            return "remove the blanks around it"
        if known := self._folded.get(tidy.casefold()):
            return f"write {known}: capitals and small letters differ"
        known = self._unpadded.get(_strip_zeros(tidy))
        return f"write {known}: leading zeros matter" if known else ""

    def _explain_alias(self, text: str) -> str:
        """Recognise a name that other tools and files use for a trial."""
        found = self._names.resolve(text)
        if isinstance(found, Resolved):
            return f"write its id, {found.trial_id}"
        if isinstance(found, Ambiguous):
            choice = f"it could be {_name_several(text, found.trial_ids)}; write one of these"
            return choice if text.isascii() else f"{_name_odd(text)}: {choice}"
        return ""

    def _name_nearest(self, text: str) -> str:
        near = find_nearest(text, self._neighbours(text))
        question = f"did you mean {near}?" if near else ""
        if text.isascii():
            return question
        return f"{_name_odd(text)}{': ' if near else ''}{question}"

    def _neighbours(self, text: str) -> list[str]:
        """List the ids that share the longest beginnings and the longest ends with a text."""
        candidates: dict[str, None] = {}
        for ordered, key, turn in ((self._forward, text, 1), (self._backward, text[::-1], -1)):
            place = bisect_left(ordered, key)
            near = ordered[max(place - NEIGHBOURS, 0) : place + NEIGHBOURS]
            candidates.update(dict.fromkeys(trial_id[::turn] for trial_id in near))
        return list(candidates)


def _key_uniquely(trial_ids: Sequence[str], form: Callable[[str], str]) -> dict[str, str]:
    """Key the ids by a form of them, leaving out those that share theirs: which was meant is not guessed."""
    forms = [form(trial_id) for trial_id in trial_ids]
    counts = Counter(forms)
    return {key: trial_id for key, trial_id in zip(forms, trial_ids, strict=True) if counts[key] == 1}


def _strip_zeros(text: str) -> str:
    """Take the leading zeros off every number, as spreadsheets do.

    >>> _strip_zeros("wall/0070")
    'wall/70'
    """
    return re.sub("(?<![0-9])0+(?=[0-9])", "", text)


def _name_several(text: str, trial_ids: Sequence[str]) -> str:
    """Name the two trials that a text resembles most, and count the others."""
    others, shown = list(trial_ids), []
    for _ in range(2):
        shown.append(find_nearest(text, others) or others[0])
        others.remove(shown[-1])
    if not others:
        return " or ".join(sorted(shown))
    return f"{', '.join(sorted(shown))} or {f'one of {len(others)} others' if others[1:] else others[0]}"


def _name_odd(text: str) -> str:
    """Name the first character of a text that no id holds, since it is not ASCII, and where it stands."""
    position, odd = next((n, c) for n, c in enumerate(text, 1) if not c.isascii())
    name = unicodedata.name(odd, "without a name")
    return f"character {position} is U+{ord(odd):04X} {name}; ids are plain ASCII"
