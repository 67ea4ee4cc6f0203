"""No link leads nowhere: not on the demo site, not on a longer board, and the checker bites."""

import gzip
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from builders import build_entry, build_reference
from site_builders import build_entries, build_material, folder_files, render_files
from tools.check_links import find_faults

N_FILLERS = 20
MAX_INDEX = 60_000
PAGE = '<!doctype html><html lang="en"><head><title>A</title></head><body id="top">{}</body></html>'


def site_of(body: str) -> dict[str, bytes]:
    """A page with this body, another page, and a file."""
    return {"in/a.html": PAGE.format(body).encode(), "b.html": PAGE.format("").encode(), "c d.csv": b""}


@pytest.fixture(scope="module")
def longer() -> dict[str, bytes]:
    """Render a board of every sort of submission and twenty more."""
    reference, rng = build_reference(), np.random.default_rng(3)
    guesses = rng.random((N_FILLERS, reference.n_trials)).tolist()
    fillers = [build_entry(reference, f"filler-{i:02d}", guess) for i, guess in enumerate(guesses)]
    return render_files(build_material(reference, build_entries(reference) + fillers))


@pytest.mark.xdist_group("demo site")
def test_every_link_of_the_demo_leads_somewhere(demo_dir: Path) -> None:
    """Links, fragments, ids and references of the site of this repository's own submissions."""
    files = folder_files(demo_dir)
    assert sum(path.endswith(".html") for path in files) > 700
    assert find_faults(files) == []


def test_every_link_of_a_longer_board_leads_somewhere(longer: dict[str, bytes]) -> None:
    """With many submissions there are more comparisons and trials with more answers."""
    assert f"submissions/filler-{N_FILLERS - 1}/index.html" in longer
    assert find_faults(longer) == []


@pytest.mark.xdist_group("demo site")
def test_the_first_page_is_light(demo_dir: Path) -> None:
    """At most 60 kB compressed, style and scripts not counted."""
    assert len(gzip.compress((demo_dir / "index.html").read_bytes())) < MAX_INDEX


def test_what_is_right_has_no_fault() -> None:
    """Files beside and above, places in pages, names with blanks, queries, other sites and letters."""
    links = ["../b.html", "../b.html#top", "#top", "../c%20d.csv", "../b.html?x=1#top", "a.html"]
    links += ["https://example.com/#x", "mailto:somebody@example.com"]
    body = "".join(f'<a href="{link}">x</a>' for link in links)
    assert find_faults(site_of(body + '<p aria-labelledby="top">x</p>')) == []


@pytest.mark.parametrize(
    ("body", "fault"),
    [
        ('<a href="gone.html">x</a>', "the link 'gone.html' leads to no file"),
        ('<img src="../gone.png" alt="">', "the link '../gone.png' leads to no file"),
        ('<a href="../../b.html">x</a>', "the link '../../b.html' leads to no file"),
        ('<a href="../">x</a>', "the link '../' leads to no file"),
        ('<a href="../b.html#gone">x</a>', "the link '../b.html#gone' leads to no id in b.html"),
        ('<a href="#gone">x</a>', "the link '#gone' leads to no id in in/a.html"),
        ('<a href="../c%20d.csv#top">x</a>', "the link '../c%20d.csv#top' leads to no id in c d.csv"),
        ('<a href="/b.html">x</a>', "the link '/b.html' is not relative"),
        ('<a href="//example.com/">x</a>', "the link '//example.com/' is not relative"),
        ('<a href="javascript:run()">x</a>', "the link 'javascript:run()' is not relative"),
        (
            '<img src="https://example.com/x.png" alt="">',
            "the link 'https://example.com/x.png' loads something from elsewhere",
        ),
        ('<p id="twice"></p><p id="twice"></p>', "the id 'twice' is given 2 times"),
        ('<p aria-describedby="top gone">x</p>', "refers to the id 'gone', which is not on the page"),
    ],
)
def test_what_is_wrong_is_found(body: str, fault: str) -> None:
    """Each fault is named with its page, and nothing else is."""
    assert find_faults(site_of(body)) == [f"in/a.html: {fault}"]


@pytest.mark.parametrize(
    ("body", "status", "said"),
    [("", 0, "0 faults in 1 pages"), ('<a href="x">x</a>', 1, "1 faults in 1 pages")],
)
def test_the_checker_is_a_command(tmp_path: Path, body: str, status: int, said: str) -> None:
    """It prints the faults of a folder and how many there are, and its exit status tells."""
    (tmp_path / "index.html").write_text(PAGE.format(body), encoding="utf-8")
    script = Path(__file__).resolve().parents[2] / "tools" / "check_links.py"
    done = subprocess.run(
        [sys.executable, str(script), str(tmp_path)], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout.splitlines()[-1]) == (status, said)
