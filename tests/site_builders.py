"""Websites to look at in tests: made in memory from graded submissions, or built from an instance on disk."""

import datetime as dt
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from xml.etree.ElementTree import Element

import html5lib
import numpy as np

from builders import build_entry, build_reference
from leaderboard.instance import Instance
from leaderboard.models import Check
from leaderboard.ranking import Entry
from leaderboard.reference import Reference, load_reference
from leaderboard.submitting import render_metadata, replace_submission
from leaderboard.website.building import compose_pages, render_site
from leaderboard.website.material import Material, Publication, gather
from reference_folders import DEFINITION, ReferenceFolder

DAY = dt.date(2026, 3, 4)
TRACKS = '[[tracks]]\nid = "all"\ntitle = "All"\ndefault = true\n'
TWO_TRACKS = """\
[[tracks]]
id = "with"
title = "With"
testing = "with_property"
default = true

[[tracks]]
id = "without"
title = "Without"
testing = "without_property"
"""

# What a stranger may write into submission.toml, meant for a browser, a template or a spreadsheet.
HOSTILE_NAME = "=cmd()|'<img src=x onerror=alert(1)>"
HOSTILE_TEAM = '"></th></table><script>alert(2)</script>'
HOSTILE_TEXT = "{{ 7 * 7 }} {% raw %} ]]> <!-- &lt;b&gt; </title><style>*{display:none}</style> \\u202e"


def build_entries(reference: Reference) -> list[Entry]:
    """Grade one submission of every sort: ranked, tied, hostile, partial, checked, on two tracks, on none."""
    rng = np.random.default_rng(4)
    n, labels = reference.n_trials, reference.labels
    beta = (reference.properties == 1).tolist()
    alpha_one = (reference.scenarios == 0).tolist()
    good = np.where(labels == 1, 0.8, 0.3).tolist()
    entries = [
        build_entry(reference, "good", good, name="Good", inputs="state", family="particle"),
        build_entry(reference, "good-too", good, name="Good too"),
        build_entry(
            reference,
            "hostile",
            rng.random(n).tolist(),
            name=HOSTILE_NAME,
            team=HOSTILE_TEAM,
            description=HOSTILE_TEXT,
        ),
        build_entry(reference, "other-track", rng.random(n).tolist(), testing="without_property"),
        build_entry(reference, "nowhere", rng.random(n).tolist(), testing="fully_observed", name="Nowhere"),
        build_entry(reference, "part", rng.random(n).tolist(), covered=beta, name="Part"),
        build_entry(reference, "sliver", rng.random(n).tolist(), covered=alpha_one, name="Sliver"),
        build_entry(reference, "flat", [0.5] * n, family="baseline", name="Chance"),
        build_entry(reference, "oracle", labels.astype(float).tolist(), family="baseline", name="Oracle"),
    ]
    check = Check(code="near-duplicate", message="nearly equal to <b>another</b>")
    checked = entries[1].result.model_copy(update={"checks": (check,)})
    entries[1] = replace(entries[1], result=checked)
    return entries


def build_material(reference: Reference | None = None, entries: list[Entry] | None = None) -> Material:
    """Gather a website's material from entries, by default one of every sort."""
    reference = reference or build_reference()
    chosen = build_entries(reference) if entries is None else entries
    publications = [
        Publication(
            entry,
            {
                "predictions.csv": b"trial_id,probability\n",
                "submission.toml": b"",
            },
        )
        for entry in chosen
    ]
    return gather(reference, publications)


def render_files(material: Material) -> dict[str, bytes]:
    """Render a whole site into memory, path to bytes."""
    return dict(render_site(material, compose_pages(material)))


def write_instance(root: Path, *, submissions: bool = True) -> Instance:
    """Write an instance with two tracks and, if wanted, a submission of most sorts."""
    instance = ReferenceFolder(definition=DEFINITION.replace(TRACKS, TWO_TRACKS)).write(root)
    reference = load_reference(instance)
    beta = [trial_id for trial_id in reference.trial_ids if trial_id.startswith("beta")]
    if submissions:
        _write_submission(instance, reference, "good", reference.trial_ids)
        _write_submission(
            instance, reference, "hostile", reference.trial_ids, name=HOSTILE_NAME, team=HOSTILE_TEAM
        )
        _write_submission(instance, reference, "part", beta)
        _write_submission(instance, reference, "other-track", beta, testing="without_property")
        _write_submission(instance, reference, "flat", reference.trial_ids, family="baseline")
    return instance


def _write_submission(
    instance: Instance,
    reference: Reference,
    slug: str,
    trial_ids: tuple[str, ...] | list[str],
    **changes: str,
) -> None:
    about = {"name": slug, "system": slug, "team": "Team", "date": DAY, "description": HOSTILE_TEXT}
    model: dict[str, object] = {"family": "other", "inputs": "rgb"}
    protocol: dict[str, object] = {"training": "separate", "testing": "with_property"}
    sections: dict[str, dict[str, object]] = {
        "submission": about | {key: value for key, value in changes.items() if key in about},
        "protocol": protocol | {key: value for key, value in changes.items() if key in protocol},
        "model": model | {key: value for key, value in changes.items() if key in model},
        "links": {"paper": "https://example.com/?a=1&b=2"},
        "contact": {"github": "someone"},
    }
    if changes.get("family") == "baseline":
        rows = [f"{trial_id},0.5" for trial_id in trial_ids]
    else:
        rows = [f"{trial_id},{(7 * index % 11) / 10}" for index, trial_id in enumerate(trial_ids)]
    quoted = [f'"{row.rpartition(",")[0]}",{row.rpartition(",")[2]}' for row in rows]
    predictions = "\n".join(["trial_id,probability", *quoted, ""]).encode()
    replace_submission(instance, reference, slug, render_metadata(sections), predictions, today=DAY)


def parse_html(content: bytes) -> Element:
    """Parse a page as a browser would, and fail where it is not as the standard wants it."""
    tree: Element = html5lib.HTMLParser(strict=True, namespaceHTMLElements=False).parse(content)
    return tree


def text_of(element: Element) -> str:
    """All text inside an element, blanks collapsed."""
    return " ".join("".join(element.itertext()).split())


def score_of(cell: Element) -> str:
    """The number that a cell of a table shows, without what stands below it."""
    return next(text.strip() for text in cell.itertext() if text.strip())


def interval_of(cell: Element) -> str:
    """The interval below a number, as it is printed; nothing where there is none."""
    return "".join((part.text or "").strip() for part in cell.iter() if part.get("class") == "interval")


def html_files(files: dict[str, bytes]) -> Iterator[tuple[str, Element]]:
    """Parse every page of a site."""
    yield from ((path, parse_html(content)) for path, content in files.items() if path.endswith(".html"))


def folder_files(folder: Path) -> dict[str, bytes]:
    """Read a whole folder, path to bytes."""
    paths = sorted(path for path in folder.rglob("*") if path.is_file())
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in paths}
