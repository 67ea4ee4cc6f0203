"""What Physion is: its definition, its official files, and the names that they give its scenarios."""

from dataclasses import dataclass

import tomli_w

from leaderboard.models import Source

STIMULI_FILE = "stimulus_names_and_labels.csv"
STIMULI_SHA256 = "b62791a59978f929ca89ea4f58fe7314899d19810588f9bad0708294651c87f2"
HUMANS_FOLDER = "humans"

# The public repository at the commit whose files the recipe was written for.
_REPOSITORY = "https://github.com/cogtoolslab/physics-benchmarking-neurips2021/raw/fd02f3f"
_TRIALS = 150

_DEFAULT_TRACK = "all-scenarios"
_TRACKS = (
    ("all-scenarios", "Trained on all scenarios", "unified"),
    ("same-scenario", "Trained on the same scenario", "separate"),
    ("zero-shot", "Not trained on the scenarios", "zero_shot"),
)


@dataclass(frozen=True)
class OfficialProperty:
    """One property and its one scenario, of the same name in lower case.

    ``aliases`` are the scenario's names in the official files and in logs of models; ``human_file`` is how
    people judged it, and ``human_sha256`` the checksum of that file.
    """

    name: str
    aliases: tuple[str, ...]
    human_file: str
    human_sha256: str

    @property
    def scenario(self) -> str:
        """The id of its scenario."""
        return self.name.lower()

    @property
    def file(self) -> str:
        """The name of its list of trials."""
        return f"{self.name}.csv"

    @property
    def names(self) -> tuple[str, ...]:
        """All that the official files call it."""
        return (self.scenario, *self.aliases)


PROPERTIES = (
    OfficialProperty(
        "Dominoes",
        (),
        "human_accuracy-dominoes_pilot-production_1_testing.csv",
        "f4abf9157ae3d69e2fd3b0b3a2d972cee6a9276fd02d4b40f0b087f3b343fd89",
    ),
    OfficialProperty(
        "Support",
        ("towers",),
        "human_accuracy-towers_pilot-production_2_testing.csv",
        "ede662d666b24d88ecc394be67d452e3d335afb6a05a85f3ba0878e26d2f0b10",
    ),
    OfficialProperty(
        "Collide",
        ("collision",),
        "human_accuracy-collision_pilot-production_2_testing.csv",
        "969699b1cd2121dddff66bfb2e1dd2849d4caf6b91c8609c1d44872c314e28a7",
    ),
    OfficialProperty(
        "Contain",
        ("containment",),
        "human_accuracy-containment_pilot-production_2_testing.csv",
        "dc99ec60fce759a3525d682a7be5b63c696c120d6ab80bb09896609bf508ed9c",
    ),
    OfficialProperty(
        "Drop",
        (),
        "human_accuracy-drop_pilot-production_2_testing.csv",
        "fb50ef5c8f6df48e4425092f152df617e0858140003ab83ea824ec15b723cc61",
    ),
    OfficialProperty(
        "Link",
        ("linking",),
        "human_accuracy-linking_pilot-production_2_testing.csv",
        "d697b4b24518a2eb1cd1fa5e2a9bb4a199cc7d7dbfc151e0fa3df96c64490a14",
    ),
    OfficialProperty(
        "Roll",
        ("rollingsliding", "rollslide"),
        "human_accuracy-rollingsliding_pilot-production_2_testing.csv",
        "b9a9e27cee9f84e62de9c5f4f81a64bc6ad717d1db84e2b8e25b33d61dfc9c65",
    ),
    OfficialProperty(
        "Drape",
        ("clothiness", "cloth"),
        "human_accuracy-clothiness_pilot-production_2_testing.csv",
        "5a094974f874feffbae5eceda6779a66b48f0178675aafa5254413e2219e55c6",
    ),
)

OFFICIAL_SOURCES = (
    Source(
        what="trials, scenarios and labels",
        url=f"{_REPOSITORY}/stimuli/{STIMULI_FILE}",
        sha256=STIMULI_SHA256,
    ),
    *(
        Source(
            what=f"human accuracy on {p.name}",
            url=f"{_REPOSITORY}/results/csv/{HUMANS_FOLDER}/{p.human_file}",
            sha256=p.human_sha256,
        )
        for p in PROPERTIES
    ),
)


def render_definition() -> bytes:
    """Write ``benchmark.toml``.

    The question is the one that people were asked. A track takes every way of testing, because the
    predecessor has no property to infer or to hide.
    """
    general = {
        "name": "physion",
        "title": "Physion",
        "version": "1",
        "question": "Is the red object going to hit the yellow area?",
    }
    grading = {"easy": "2/3", "hard": "1/3", "resamples": 10_000, "seed": 20211206}
    tables: dict[str, list[dict[str, object]]] = {
        "properties": [
            {"name": p.name, "file": p.file, "aliases": list(p.aliases), "trials": _TRIALS}
            for p in PROPERTIES
        ],
        "scenarios": [
            {"id": p.scenario, "title": p.name, "property": p.name, "trials": _TRIALS} for p in PROPERTIES
        ],
        "tracks": [
            {"id": name, "title": title, "training": training, "default": name == _DEFAULT_TRACK}
            for name, title, training in _TRACKS
        ],
        "sources": [source.model_dump(include={"what", "url", "sha256"}) for source in OFFICIAL_SOURCES],
    }
    parts = [tomli_w.dumps(general), "[grading]\n" + tomli_w.dumps(grading)]
    parts += [f"[[{kind}]]\n" + tomli_w.dumps(table) for kind, rows in tables.items() for table in rows]
    return "\n".join(parts).encode()
