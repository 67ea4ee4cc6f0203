"""Figures as PNG, with a font that comes along: the same bytes on every machine."""

from importlib.resources import files

from leaderboard.errors import InstanceError

FAMILY = "Liberation Sans"
FAMILIES = f"{FAMILY}, Arial, Helvetica, sans-serif"
"""Whose letters have the same widths, so that a figure looks alike where the first is not there."""

FONTS = ("LiberationSans-Regular.ttf", "LiberationSans-Bold.ttf")


def render_png(svg: str) -> bytes:
    """Render an SVG without variables or outer files as PNG, in its own size.

    Raises
    ------
    InstanceError
        If the package that draws it is not there.
    """
    try:
        from resvg_py import svg_to_bytes
    except ImportError as error:
        raise InstanceError(
            f"figures cannot be drawn as PNG, because resvg-py cannot be loaded: {error}",
            "install the leaderboard anew with all its dependencies, or run: python -m pip install resvg-py",
        ) from error
    folder = files("leaderboard.website") / "fonts"
    fonts = [str(folder / name) for name in FONTS]
    return bytes(
        svg_to_bytes(
            svg_string=svg,
            skip_system_fonts=True,
            font_files=fonts,
            font_family=FAMILY,
            sans_serif_family=FAMILY,
        )
    )
