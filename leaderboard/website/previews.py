"""The picture that others show beside a link to the site: what it is, and the top of its first board."""

from dataclasses import replace

from leaderboard.models.benchmark import OVERALL
from leaderboard.website.describing import count_of, warn_of_simulation
from leaderboard.website.figure_exports import LEADING, MARGIN, Picture, Placed, render_svg, write_words
from leaderboard.website.figures.marks import WIDTH, Drawing, Sketch
from leaderboard.website.figures.palette import BOLD, HEADING, ON_THEIR_OWN, TEXT, TITLE
from leaderboard.website.forests import draw_top
from leaderboard.website.material import Material
from leaderboard.website.pages import Frame
from leaderboard.website.rasterizing import render_png

PREVIEW_WIDTH, PREVIEW_HEIGHT = 600, 315
"""In units, of which each is two pixels: 1,200 by 630, which is what those who show it ask for."""

N_ROWS = 8


def render_preview(material: Material, frame: Frame) -> bytes:
    """Render the picture as PNG."""
    return render_png(render_svg(compose_preview(material, frame)))


def compose_preview(material: Material, frame: Frame) -> Picture:
    """Write what the site is about on the left, and draw the first rows of the board on the right."""
    sketch, drawing = Sketch(bottom=2 * MARGIN), draw_top(material.boards[0], material, N_ROWS)
    width = PREVIEW_WIDTH - WIDTH - 4 * MARGIN if drawing else PREVIEW_WIDTH - 4 * MARGIN
    place = (2 * MARGIN, width)
    write_words(sketch, TITLE, frame.title, place)
    sketch.bottom += MARGIN
    for words in (_count_all(material), frame.benchmark):
        write_words(sketch, TEXT, words, place)
    sketch.bottom += MARGIN
    write_words(sketch, BOLD, warn_of_simulation(material), place)
    placed = _place(sketch, drawing) if drawing else ()
    sketch.bottom = PREVIEW_HEIGHT
    around = sketch.finish("preview", frame.title, caption="", description=frame.title, numbers={})
    return Picture(replace(around, width=PREVIEW_WIDTH, palette=ON_THEIR_OWN), placed)


def _count_all(material: Material) -> str:
    entries = (publication.entry for publication in material.publications)
    n_submissions = sum(not entry.is_baseline for entry in entries)
    return f"{count_of(n_submissions, 'submission')}, {count_of(material.count(OVERALL).n, 'trial')}"


def _place(sketch: Sketch, drawing: Drawing) -> tuple[Placed, ...]:
    left = PREVIEW_WIDTH - WIDTH - MARGIN
    sketch.bottom = 2 * MARGIN
    write_words(sketch, HEADING, drawing.title, (left, WIDTH))
    top = sketch.bottom + LEADING * MARGIN
    return (Placed(left, top, replace(drawing, palette=ON_THEIR_OWN)),)
