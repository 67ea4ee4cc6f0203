"""Any trial id has a page under an address that every host and file system takes."""

import re

from hypothesis import given
from hypothesis import strategies as st

from leaderboard.ids import MAX_ID_LENGTH, is_id
from leaderboard.website.trial_paths import trial_anchor, trial_path

SIGNS = [chr(code) for code in range(33, 127) if is_id(chr(code))]
IDS = st.text(SIGNS, min_size=1, max_size=MAX_ID_LENGTH)


@given(IDS)
def test_a_path_is_safe_for_every_host(trial_id: str) -> None:
    """Lower-case letters, digits and single hyphens, none at an end, and short enough for any file system."""
    path = trial_path(trial_id)
    assert re.fullmatch(r"trials/[a-z0-9]+(-[a-z0-9]+)*/index\.html", path)
    assert len(path) < 100
    assert re.fullmatch(r"trial-[0-9a-f]{12}", trial_anchor(trial_id))


@given(st.lists(IDS, min_size=2, max_size=20, unique=True))
def test_ids_that_differ_have_paths_that_differ(trial_ids: list[str]) -> None:
    """However much they resemble each other; each has an anchor of its own too."""
    assert len({trial_path(trial_id) for trial_id in trial_ids}) == len(trial_ids)
    assert len({trial_anchor(trial_id) for trial_id in trial_ids}) == len(trial_ids)


def test_ids_that_read_alike_are_told_apart() -> None:
    """Another case, another sign, nothing but signs, or a difference beyond what is kept of a long id."""
    alike = ["a/b=1", "A/b=1", "a/b,1", "a-b-1", "/", "=", f"x{'y' * 199}", f"z{'y' * 199}"]
    assert len({trial_path(trial_id) for trial_id in alike}) == len(alike)


def test_a_path_stays_what_it_is() -> None:
    """Links from elsewhere last: a path depends on nothing but the id and is the same in every version."""
    assert trial_path("wall_pp-copy0/set=a,b/0001") == (
        "trials/wall-pp-copy0-set-a-b-0001-3aa1d88f8448/index.html"
    )
