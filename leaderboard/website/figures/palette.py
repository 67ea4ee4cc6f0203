"""Colours of figures in one place, and the inks that are mixed from them."""

from dataclasses import dataclass
from functools import cache
from typing import Literal

Colour = Literal["ink", "quiet", "line", "paper", "model", "people", "yes", "no"]


@dataclass(frozen=True)
class Palette:
    """What each colour of a figure is, as SVG wants it.

    Attributes
    ----------
    ink, quiet, line, paper
        Words, words of less weight, lines of a grid, and what is behind everything.
    model, people
        What belongs to submissions, and what to people.
    yes, no
        Trials of either label; they differ in shape as well.
    """

    ink: str
    quiet: str
    line: str
    paper: str
    model: str
    people: str
    yes: str
    no: str


ON_PAGES = Palette(
    ink="var(--ink)",
    quiet="var(--quiet)",
    line="var(--line)",
    paper="var(--paper)",
    model="var(--link)",
    people="var(--people)",
    yes="var(--yes)",
    no="var(--no)",
)
"""Named after the variables of the style sheet, so that figures follow its themes."""

ON_THEIR_OWN = Palette(
    ink="#17191c",
    quiet="#5a6068",
    line="#dedfda",
    paper="#ffffff",
    model="#1a4fb4",
    people="#8a3d00",
    yes="#00735c",
    no="#a3268a",
)
"""The light theme on white, literally: what prints and rasterises figures knows no variables."""


@dataclass(frozen=True)
class Ink:
    """How marks look; those of lower ``depth`` are drawn first and lie below others.

    ``size`` is that of letters, ``anchor`` says which end of a text its place is. Lines end round or square;
    words with a halo stay readable on lines.
    """

    depth: int
    fill: Colour | None = None
    stroke: Colour | None = None
    thickness: float = 1
    dash: str = ""
    opacity: float = 1
    size: float = 0
    anchor: Literal["start", "middle", "end"] = "start"
    is_bold: bool = False
    is_round: bool = False
    has_halo: bool = False

    def attributes(self, palette: Palette) -> tuple[tuple[str, str], ...]:
        """Name what an SVG group with this ink says of its looks, where it departs from the figure's own."""
        return _list_attributes(self, palette)


@cache
def _list_attributes(ink: Ink, palette: Palette) -> tuple[tuple[str, str], ...]:
    attributes = {
        "fill": getattr(palette, ink.fill) if ink.fill else "",
        "stroke": getattr(palette, ink.stroke) if ink.stroke else "",
        "stroke-width": f"{ink.thickness:g}" if ink.stroke and ink.thickness != 1 else "",
        "stroke-dasharray": ink.dash,
        "stroke-linecap": "round" if ink.is_round else "",
        # Not that of the group: a picture would have to be drawn a second time for each of these.
        "fill-opacity": f"{ink.opacity:g}" if ink.fill and ink.opacity < 1 else "",
        "stroke-opacity": f"{ink.opacity:g}" if ink.stroke and ink.opacity < 1 else "",
        "font-size": f"{ink.size:g}" if ink.size else "",
        "font-weight": "bold" if ink.is_bold else "",
        "paint-order": "stroke" if ink.has_halo else "",
        "text-anchor": ink.anchor if ink.anchor != "start" else "",
    }
    return tuple((name, value) for name, value in attributes.items() if value)


TITLE_SIZE = 24
HEADING_SIZE = 15
TEXT_SIZE = 12
SMALL_SIZE = 10.5

GRID = Ink(1, stroke="line")
PEOPLE_BAND = Ink(2, fill="people", opacity=0.22)
PEOPLE_LINE = Ink(3, stroke="people", thickness=1.5)
REFERENCE_LINE = Ink(3, stroke="quiet", dash="3 3")
INTERVAL = Ink(4, fill="model", opacity=0.35)
PEOPLE_INTERVAL = Ink(4, fill="people", opacity=0.35)
BAR = Ink(4, fill="model", opacity=0.45)
EMPTY_BAR = Ink(4, fill="paper", stroke="quiet")
FULL_BAR = Ink(5, fill="model")
COUNT_BAR = Ink(4, fill="quiet", opacity=0.4)
PEOPLE_BAR = Ink(4, fill="people", opacity=0.45)
POINT = Ink(6, fill="model")
PEOPLE_POINT = Ink(6, fill="people")
YES_POINT = Ink(6, stroke="yes", thickness=4.6, opacity=0.7, is_round=True)
NO_POINT = Ink(6, stroke="no", thickness=1.3, opacity=0.8)
TITLE = Ink(7, fill="ink", size=TITLE_SIZE, is_bold=True)
HEADING = Ink(7, fill="ink", size=HEADING_SIZE, is_bold=True)
TEXT = Ink(7, fill="ink", size=TEXT_SIZE)
BOLD = Ink(7, fill="ink", size=TEXT_SIZE, is_bold=True)
SMALL = Ink(7, fill="quiet", size=SMALL_SIZE)
VALUE = Ink(7, fill="ink", size=TEXT_SIZE, anchor="end")
BOLD_VALUE = Ink(7, fill="ink", size=TEXT_SIZE, anchor="end", is_bold=True)
REASON = Ink(7, fill="quiet", stroke="paper", thickness=4, size=SMALL_SIZE, has_halo=True)
REASON_END = Ink(7, fill="quiet", stroke="paper", thickness=4, size=SMALL_SIZE, has_halo=True, anchor="end")
SMALL_VALUE = Ink(7, fill="quiet", size=SMALL_SIZE, anchor="end")
PEOPLE_TEXT = Ink(7, fill="people", size=TEXT_SIZE, is_bold=True)
PEOPLE_VALUE = Ink(7, fill="people", size=TEXT_SIZE, anchor="end", is_bold=True)
TICK = Ink(7, fill="quiet", size=SMALL_SIZE, anchor="middle")
WARNING = Ink(7, fill="ink", size=SMALL_SIZE, is_bold=True)
