"""Which trial a name means: other tools and files write trial ids with decorations.

An id is compared byte for byte first. Only then is a normal form tried, and it never guesses: a name that
fits two trials is an answer of its own, which names both.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from leaderboard.ids import find_nearest

# What tools add to the last part of an id, from the outside in. Each is taken off at most once.
_DECORATIONS = (
    re.compile(r"\.(?:mp4|hdf5|png)$"),  # the kind of file
    re.compile(r"_(?:img|map)$"),  # the video, the picture with the two objects marked
    re.compile(r"-redyellow(?=(?:_[0-9]+)?$)"),  # the recoloured copy of a scene, before or after its number
)

_Form = tuple[str, ...]


@dataclass(frozen=True)
class Resolved:
    """The name means this trial."""

    trial_id: str


@dataclass(frozen=True)
class Ambiguous:
    """The name fits several trials, here in alphabetical order."""

    name: str
    trial_ids: tuple[str, ...]


@dataclass(frozen=True)
class Unknown:
    """The name fits no trial."""

    name: str
    known: Sequence[str] = field(repr=False, compare=False)

    @cached_property
    def nearest(self) -> str | None:
        """The trial id that the name most resembles, or None; looked for only when asked."""
        return find_nearest("/".join(_normal_form(self.name)), self.known)


Resolution = Resolved | Ambiguous | Unknown


class TrialNames:
    """Finds the trial that a name means.

    Parameters
    ----------
    trial_ids
        The ids of all trials, without repetition.

    Examples
    --------
    >>> names = TrialNames(["ramp_box_0001", "ramp_box_0002", "ramp_box-redyellow_0002"])
    >>> names.resolve("https://example.com/videos/ramp_box-redyellow_0001_img.mp4")
    Resolved(trial_id='ramp_box_0001')
    >>> names.resolve("ramp_box_0002")
    Resolved(trial_id='ramp_box_0002')
    >>> names.resolve("ramp_box_0002_img").trial_ids
    ('ramp_box-redyellow_0002', 'ramp_box_0002')
    >>> names.resolve("ramp_bux_0001").nearest
    'ramp_box_0001'
    """

    def __init__(self, trial_ids: Iterable[str]) -> None:
        self._trial_ids = tuple(trial_ids)
        self._exact = frozenset(self._trial_ids)
        self._by_form: dict[_Form, list[str]] = {}
        for trial_id in self._trial_ids:
            self._by_form.setdefault(_normal_form(trial_id), []).append(trial_id)
        self._depths = sorted({len(form) for form in self._by_form})

    def resolve(self, name: str) -> Resolution:
        """Tell which trial a name means, if it is exactly one.

        An id means itself. Any other name is taken without its decorations, and of a path as many last parts
        are compared as an id has.
        """
        if name in self._exact:
            return Resolved(name)
        found = self._find_by_form(_normal_form(name))
        if not found:
            return Unknown(name, self._trial_ids)
        return Resolved(found[0]) if len(found) == 1 else Ambiguous(name, tuple(found))

    def _find_by_form(self, form: _Form) -> list[str]:
        tails = [form[-depth:] for depth in self._depths if depth <= len(form)]
        return sorted(trial_id for tail in tails for trial_id in self._by_form.get(tail, []))


def _normal_form(name: str) -> _Form:
    """Split a name at its slashes and take the decorations off its last part."""
    *folders, last = name.split("/")
    for decoration in _DECORATIONS:
        last = decoration.sub("", last)
    return (*folders, last)
