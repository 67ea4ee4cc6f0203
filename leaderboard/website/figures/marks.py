"""What figures are drawn with: marks at computed places, gathered by ink into one drawing."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Literal

from leaderboard.website.figures.palette import ON_PAGES, WARNING, Ink, Palette

WIDTH = 320
"""Every figure is this many units wide: about a telephone, so that letters stay readable on one."""

Shape = Literal["dot", "small dot", "diamond", "small diamond", "left", "right", "tick", "cross", "speck"]

OUTLINES: dict[Shape, str] = {
    "dot": "m-3.4 0a3.4 3.4 0 1 0 6.8 0a3.4 3.4 0 1 0-6.8 0z",
    "small dot": "m-2.4 0a2.4 2.4 0 1 0 4.8 0a2.4 2.4 0 1 0-4.8 0z",
    "diamond": "m0-4.4l4.4 4.4-4.4 4.4-4.4-4.4z",
    "small diamond": "m0-3.2l3.2 3.2-3.2 3.2-3.2-3.2z",
    "left": "m-4 0l7-4v8z",
    "right": "m4 0l-7-4v8z",
    "tick": "m-1.2-4.5h2.4v9h-2.4z",
    "cross": "m-2-2l4 4m0-4l-4 4",
    "speck": "h0",
}
"""Each shape as an SVG path around its place.

Left and right point to what lies beyond an axis; a speck is as large as its ink's line is thick.
"""


@dataclass(frozen=True)
class Line:
    """A straight line between two places."""

    x1: float
    y1: float
    x2: float
    y2: float


@dataclass(frozen=True)
class Box:
    """A rectangle by its upper left corner; ``title`` is shown to a pointer that rests on it."""

    x: float
    y: float
    width: float
    height: float
    title: str = ""


@dataclass(frozen=True)
class Point:
    """A value at its place."""

    x: float
    y: float
    shape: Shape
    title: str = ""

    @property
    def outline(self) -> str:
        """Its shape as an SVG path."""
        return f"M{self.x} {self.y}{OUTLINES[self.shape]}"


@dataclass(frozen=True)
class Cloud:
    """Many points of one shape without titles, as a single path."""

    places: tuple[tuple[int, int], ...]
    shape: Shape

    @property
    def outline(self) -> str:
        """All points as one SVG path."""
        shape = OUTLINES[self.shape]
        return "".join(f"M{x} {y}{shape}" for x, y in self.places)


@dataclass(frozen=True)
class Steps:
    """A line that goes across first, then up or down, from place to place."""

    places: tuple[tuple[float, float], ...]

    @property
    def outline(self) -> str:
        """The steps as an SVG path."""
        (x, y), *rest = self.places
        return f"M{x} {y}" + "".join(f"H{x}V{y}" for x, y in rest)


@dataclass(frozen=True)
class Text:
    """Words at a place; ``title`` holds them in full where they are cut."""

    x: float
    y: float
    text: str
    title: str = ""


Mark = Line | Box | Point | Cloud | Steps | Text

Numbers = Mapping[str, Iterable[object]]
"""The numbers behind a figure: columns of one length by their names; None where there is no number."""


@dataclass(frozen=True)
class Layer:
    """The marks of one ink, by kind."""

    ink: Ink
    lines: tuple[Line, ...]
    boxes: tuple[Box, ...]
    points: tuple[Point, ...]
    paths: tuple[Cloud | Steps, ...]
    texts: tuple[Text, ...]

    @property
    def outline(self) -> str:
        """Its lines and the boxes that have no title, as one SVG path: half as long as one for each."""
        lines = (f"M{line.x1} {line.y1}L{line.x2} {line.y2}" for line in self.lines)
        boxes = (
            f"M{box.x} {box.y}h{box.width}v{box.height}h-{box.width}z" for box in self.boxes if not box.title
        )
        return "".join((*lines, *boxes))


@dataclass(frozen=True)
class Drawing:
    """A figure ready to be printed.

    Attributes
    ----------
    key
        Names it within its page.
    title, caption
        Above the figure.
    description
        The key numbers in words, for whoever cannot see it.
    layers
        What lies below first.
    numbers
        What it was drawn from.
    """

    key: str
    title: str
    caption: str
    description: str
    height: float
    layers: tuple[Layer, ...]
    numbers: Numbers = field(compare=False)
    width: float = WIDTH
    palette: Palette = ON_PAGES


@dataclass
class Sketch:
    """A drawing in the making: marks by ink, and how far down it reaches so far."""

    bottom: float = 0
    _marks: dict[Ink, list[Mark]] = field(default_factory=dict)

    def add(self, ink: Ink, *marks: Mark) -> None:
        """Put marks down."""
        self._marks.setdefault(ink, []).extend(marks)

    def warn(self, words: str) -> None:
        """Write below everything what a reader must know; nothing without words."""
        if words:
            self.bottom += 16
            self.add(WARNING, Text(0, self.bottom - 4, words))

    def finish(self, key: str, title: str, *, caption: str, description: str, numbers: Numbers) -> Drawing:
        """Order the marks by depth, those of one depth by their first use."""
        inks = sorted(self._marks, key=lambda ink: ink.depth)
        layers = tuple(_sort_out(ink, self._marks[ink]) for ink in inks)
        return Drawing(key, title, caption, description, tidy(self.bottom), layers, numbers)


def _sort_out(ink: Ink, marks: list[Mark]) -> Layer:
    return Layer(
        ink,
        tuple(mark for mark in marks if isinstance(mark, Line)),
        tuple(mark for mark in marks if isinstance(mark, Box)),
        tuple(mark for mark in marks if isinstance(mark, Point)),
        tuple(mark for mark in marks if isinstance(mark, Cloud | Steps)),
        tuple(mark for mark in marks if isinstance(mark, Text)),
    )


def tidy(coordinate: float) -> float:
    """Round to a tenth of a unit, and to a whole number where that is one, so that it prints short.

    >>> tidy(12.04), tidy(12.06)
    (12, 12.1)
    """
    rounded = round(coordinate, 1)
    return int(rounded) if rounded == int(rounded) else rounded
