"""What submit says of names that it translated."""

from leaderboard.report.translation import render_translations
from leaderboard.validation.translating import TranslatedName


def test_one_name_is_shown_with_its_trial() -> None:
    """The name is quoted, as a participant wrote it."""
    names = [TranslatedName("videos/ramp_0001_img.mp4", "ramp_0001")]
    assert render_translations(names) == (
        "1 name was translated to its trial id: 'videos/ramp_0001_img.mp4' -> ramp_0001"
    )


def test_many_names_are_counted_with_an_example() -> None:
    """The first stands for all."""
    names = [TranslatedName(f"ramp_{n:04d}.mp4", f"ramp_{n:04d}") for n in range(1192)]
    assert render_translations(names) == (
        "1,192 names were translated to trial ids, for instance 'ramp_0000.mp4' -> ramp_0000"
    )


def test_hostile_names_are_escaped_and_cut() -> None:
    """Nothing in a name steers the terminal or fills the screen."""
    shown = render_translations([TranslatedName(f"\x1b[2J\u202e{'x' * 4000}/ramp_0001", "ramp_0001")])
    assert shown.isprintable()
    assert len(shown) < 200


def test_nothing_translated_is_nothing_to_say() -> None:
    """No line at all."""
    assert render_translations([]) == ""
