"""The plot of reliability: sound SVG, with the numbers of the report in it."""

import re
from dataclasses import replace
from xml.etree import ElementTree as ET

import pytest

from builders import build_reference
from feature_sets import simulate_readout
from leaderboard.readout import Readout, Settings, fit_readout, render_reliability
from leaderboard.readout.evaluation import bin_probabilities

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(scope="module")
def readout() -> Readout:
    reference = build_reference()
    return fit_readout(*simulate_readout(reference), reference, Settings(n_seeds=1))


def test_each_bin_is_a_point_at_its_place(readout: Readout) -> None:
    """Each part has a point for each bin that holds trials, at both means, with the numbers in its title."""
    tree = ET.fromstring(render_reliability(readout))  # noqa: S314 - made here
    groups = tree.findall(f"{SVG}g")
    assert len(groups) == len(readout.parts)
    for group, part in zip(groups, readout.parts, strict=True):
        bins = [bin_ for bin_ in bin_probabilities(part.held_out, part.labels) if bin_.n]
        circles = group.findall(f"{SVG}circle")
        assert [float(c.attrib["cx"]) for c in circles] == [
            pytest.approx(200 * (b.predicted or 0), abs=0.06) for b in bins
        ]
        assert [float(c.attrib["cy"]) for c in circles] == [
            pytest.approx(200 * (1 - (b.observed or 0)), abs=0.06) for b in bins
        ]
        title = circles[0].findtext(f"{SVG}title") or ""
        assert re.fullmatch(
            r"P\(YES\) 0\.\d{3}, YES was right [01]\.\d{3} \(95 % interval .*\), \d+ trials", title
        )


def test_colours_are_literal_and_names_escaped(readout: Readout) -> None:
    """The file needs no style sheet, and whatever a part is called, it stays well formed."""
    part = replace(readout.parts[0], name="<A & B>")
    text = render_reliability(replace(readout, parts=(part,))).decode()
    assert "var(" not in text
    assert "&lt;A &amp; B&gt;</text>" in text
    assert ET.fromstring(text).attrib["width"] == "270"  # noqa: S314 - made here
