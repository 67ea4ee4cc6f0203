"""The reliability of held-out probabilities as an SVG file that needs nothing else to be seen."""

from collections.abc import Iterator
from html import escape

from leaderboard.metrics.published import wilson_interval
from leaderboard.models import Bin
from leaderboard.readout.evaluation import bin_probabilities
from leaderboard.readout.outcome import PartOutcome, Readout

SIDE, LEFT, TOP, GAP, BELOW = 200, 40, 40, 60, 52
TICKS = (0.0, 0.25, 0.5, 0.75, 1.0)
INK, QUIET, LINE, PAPER, MODEL = "#1c1c1c", "#5c5c5c", "#d8d8d8", "#ffffff", "#0b57a4"


def render_reliability(readout: Readout) -> bytes:
    """Draw a reliability diagram for each part: how often YES was right, by held-out P(YES).

    Bars are 95 % Wilson intervals that take trials as independent; numbers in titles are told to a pointer
    that rests on a point, and to a screen reader.
    """
    width = LEFT + len(readout.parts) * (SIDE + GAP) - GAP // 2
    height = TOP + SIDE + BELOW
    title = f"{readout.benchmark}: reliability of the readout on the trials that it was fitted on, held out"
    size = f'width="{width}" height="{height}"'
    style = f'font-family="sans-serif" font-size="11" fill="{INK}"'
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" role="img" {size} viewBox="0 0 {width} {height}" {style}>',
        f"<title>{escape(title)}</title>",
        f'<rect {size} fill="{PAPER}"/>',
        *(line for number, part in enumerate(readout.parts) for line in _draw_part(number, part)),
        "</svg>",
    ]
    return ("\n".join(lines) + "\n").encode()


def _draw_part(number: int, part: PartOutcome) -> Iterator[str]:
    yield f'<g transform="translate({LEFT + number * (SIDE + GAP)} {TOP})">'
    yield f'<text y="-22" font-size="13" font-weight="bold">{escape(part.name)}</text>'
    yield f'<text y="-7" fill="{QUIET}">YES was right, by held-out P(YES)</text>'
    yield from _draw_square()
    for bin_ in bin_probabilities(part.held_out, part.labels):
        yield from _draw_bin(bin_)
    counts = f"{part.n_trials:,} trials, accuracy {part.agreement.accuracy:.3f}, ECE {part.agreement.ece:.3f}"
    yield f'<text y="{SIDE + 38}" fill="{QUIET}">{counts}</text>'
    yield "</g>"


def _draw_square() -> Iterator[str]:
    for tick in TICKS:
        x, y = _across(tick), _upward(tick)
        yield f'<path d="M{x} 0V{SIDE}M0 {y}H{SIDE}" stroke="{LINE}"/>'
        yield f'<text x="{x}" y="{SIDE + 15}" text-anchor="middle" fill="{QUIET}">{tick:g}</text>'
        yield f'<text x="-5" y="{y + 4}" text-anchor="end" fill="{QUIET}">{tick:g}</text>'
    yield f'<path d="M0 {SIDE}L{SIDE} 0" stroke="{QUIET}" stroke-dasharray="3 3"/>'


def _draw_bin(bin_: Bin) -> Iterator[str]:
    if bin_.predicted is None or bin_.observed is None:
        return
    low, high = wilson_interval(bin_.observed, bin_.n)
    x, top, bottom = _across(bin_.predicted), _upward(high), _upward(low)
    yield f'<path d="M{x} {top}V{bottom}" stroke="{MODEL}" stroke-width="6" opacity="0.35"/>'
    words = (
        f"P(YES) {bin_.predicted:.3f}, YES was right {bin_.observed:.3f}"
        f" (95 % interval {low:.3f} to {high:.3f}), {bin_.n:,} trials"
    )
    yield (
        f'<circle cx="{x}" cy="{_upward(bin_.observed)}" r="3.5" fill="{MODEL}">'
        f"<title>{words}</title></circle>"
    )


def _across(share: float) -> float:
    return round(SIDE * share, 1)


def _upward(share: float) -> float:
    return round(SIDE * (1 - share), 1)
