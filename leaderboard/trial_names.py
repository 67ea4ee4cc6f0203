"""Which trial a name means: other tools and files write trial ids with folders and decorations.

An id is compared byte for byte first. Only then are normal forms tried, and they never guess: a name that
fits two trials is an answer of its own, which names both.
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from urllib.parse import unquote

from leaderboard.ids import find_nearest

MAX_NAME_LENGTH = 4096  # of a path; what is longer is no name

# What tools append to an id or to a folder in it: what a file shows, and its kind, which folders may have
# after an underscore.
_SHOWN = "img|image|aimg|ifimg|id|seg|cue|map"
_KINDS = (
    "mp4|avi|webm|mov|mkv|gif|png|jpg|jpeg|webp|hdf5|h5|npz|npy|pkl|pickle|pt|pth|mat|"
    "json|jsonl|csv|txt|gz|zip|tar|zst"
)
_RECOLOURED = "-redyellow"  # a scene with the two objects in these colours
_DECORATION = re.compile(rf"(?:_(?:{_SHOWN})|[._](?:{_KINDS})|{_RECOLOURED})\Z")
_LONGEST = len(_RECOLOURED)

_COPY_MARK = re.compile(r"(?<=.)-copy[0-9]+\Z")  # at the end of a folder that holds one member of each pair
_COPY_NUMBER = re.compile(r"copy[ _=-]?[0-9]", re.IGNORECASE)  # any word on which member is meant

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
        return find_nearest("/".join(_normal_form(self.name[:MAX_NAME_LENGTH])), self.known)


Resolution = Resolved | Ambiguous | Unknown


class TrialNames:
    r"""Finds the trial that a name means.

    An id means itself. Any other name is a path or a link; it is split at its slashes, of either kind, every
    part is taken without its decorations, and as many last parts are compared as an id has. Where ids have a
    folder that ends in ``-copy<k>``, a name that says nothing of copies may lack that mark, or the folder; it
    then fits every copy, and means none unless there is one copy of everything.

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

    >>> names = TrialNames(["wall-copy0/zone=far/0007", "wall-copy1/zone=far/0007"])
    >>> names.resolve(r"D:\my data\wall-copy1_mp4\zone=far\0007_img.mp4")
    Resolved(trial_id='wall-copy1/zone=far/0007')
    >>> names.resolve("zone=far/0007_img.mp4").trial_ids
    ('wall-copy0/zone=far/0007', 'wall-copy1/zone=far/0007')
    """

    def __init__(self, trial_ids: Iterable[str]) -> None:
        self._trial_ids = tuple(trial_ids)
        self._exact = frozenset(self._trial_ids)
        self._full, self._unmarked, self._below_copy = _Index(), _Index(), _Index()
        self._copy_marks: set[str] = set()
        for trial_id in self._trial_ids:
            self._add(trial_id, _normal_form(trial_id))

    def _add(self, trial_id: str, form: _Form) -> None:
        self._full.add(form, trial_id)
        folders = form[:-1]
        marked = [place for place, folder in enumerate(folders, 1) if _COPY_MARK.search(folder)]
        self._copy_marks.update(found[0] for folder in folders if (found := _COPY_MARK.search(folder)))
        if marked:
            unmarked = (_undecorate(_COPY_MARK.sub("", folder)) for folder in folders)
            self._unmarked.add((*unmarked, form[-1]), trial_id)
            self._below_copy.add(form[marked[-1] :], trial_id)

    def resolve(self, name: str) -> Resolution:
        """Tell which trial a name means, if it is exactly one."""
        if name in self._exact:
            return Resolved(name)
        if len(name) > MAX_NAME_LENGTH:
            return Unknown(name, self._trial_ids)
        says_copy = _COPY_NUMBER.search(name) is not None
        found = {t for form in _read_forms(name) for t in self._find(form, says_copy=says_copy)}
        if not found:
            return Unknown(name, self._trial_ids)
        return Resolved(*found) if len(found) == 1 else Ambiguous(name, tuple(sorted(found)))

    def _find(self, form: _Form, *, says_copy: bool) -> Sequence[str]:
        found = [*self._full.find_end(form)]
        if says_copy:
            return found  # falling back on another copy would be wrong
        lacking = [*self._unmarked.find_end(form), *self._below_copy.find(form)]
        if found or len({*lacking}) > 1 or len(self._copy_marks) == 1:
            return found + lacking
        # A single trial that fits may be the wrong one: its other copy may not be here, and below other
        # folders the folder of the copy may be of another scenario. Several are worth naming.
        several = [*self._below_copy.find_end(form)]
        return several if len(several) > 1 else ()


class _Index:
    """Trial ids by their forms."""

    def __init__(self) -> None:
        self._by_form: dict[_Form, list[str]] = {}
        self._depths: set[int] = set()

    def add(self, form: _Form, trial_id: str) -> None:
        """Take in an id by a form; an empty form is none."""
        if form:
            self._by_form.setdefault(form, []).append(trial_id)
            self._depths.add(len(form))

    def find(self, form: _Form) -> Sequence[str]:
        """List the ids of exactly this form."""
        return self._by_form.get(form, ())

    def find_end(self, form: _Form) -> Iterator[str]:
        """List the ids whose forms are the last parts of this one."""
        for depth in self._depths:
            if depth <= len(form):
                yield from self.find(form[-depth:])


def _read_forms(name: str) -> Iterator[_Form]:
    """Yield the normal forms of a name: as it stands, and, if it is a link, as a server would read it."""
    yield _normal_form(name)
    if "://" in name:
        yield _normal_form(unquote(re.split("[?#]", name, maxsplit=1)[0]))


def _normal_form(name: str) -> _Form:
    r"""Split a name at its slashes and take the decorations off each part.

    >>> _normal_form(r"C:\\test data\wall-copy0_mp4\0007-redyellow_img.mp4")
    ('C:', 'test data', 'wall-copy0', '0007')
    """
    return tuple(_undecorate(part) for part in name.replace("\\", "/").split("/") if part)


def _undecorate(part: str) -> str:
    """Take all decorations off the end of a part, and the mark of a recoloured scene off before a number.

    Something always remains.

    >>> _undecorate("ramp-redyellow_0001_img.mp4"), _undecorate("_img.png")
    ('ramp_0001', '_img')
    """
    end = len(part)
    while found := _DECORATION.search(part, max(1, end - _LONGEST), end):
        end = found.start()
    scene, underscore, number = part[:end].rpartition("_")
    if number.isdecimal():
        while scene.endswith(_RECOLOURED) and scene != _RECOLOURED:
            scene = scene.removesuffix(_RECOLOURED)
    return f"{scene}{underscore}{number}"
