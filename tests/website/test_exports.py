"""The numbers for programs: JSON and CSV say what the pages say."""

import csv
import io
import json

import pytest

from builders import build_reference
from leaderboard.grading import METRICS, SUBSETS, result_bytes
from leaderboard.website.exports import reference_data, render_csv, render_trials
from leaderboard.website.material import Material
from site_builders import HOSTILE_NAME, HOSTILE_TEAM, build_material


@pytest.fixture(scope="module")
def rows(files: dict[str, bytes]) -> dict[str, dict[str, str]]:
    text = files["leaderboard.csv"].decode()
    return {row["slug"]: row for row in csv.DictReader(io.StringIO(text))}


def test_the_table_has_one_row_per_submission(
    rows: dict[str, dict[str, str]], files: dict[str, bytes]
) -> None:
    """Ranked by track, then baselines and submissions without a track; nobody twice."""
    kinds = {slug: (row["track"], row["rank"], row["kind"]) for slug, row in rows.items()}
    assert kinds == {
        "good": ("with", "1", "ranked"),
        "good-too": ("with", "1", "ranked"),
        "hostile": ("with", "3", "ranked"),
        "part": ("with", "", "partial"),
        "sliver": ("with", "", "partial"),
        "other-track": ("without", "1", "ranked"),
        "oracle": ("", "", "baseline"),
        "flat": ("", "", "baseline"),
        "nowhere": ("", "", "undefined"),
    }
    assert len(files["leaderboard.csv"].splitlines()) == len(rows) + 1


def test_the_table_has_every_metric_overall_and_by_property(
    rows: dict[str, dict[str, str]], material: Material
) -> None:
    """Values and intervals are those of the results with all digits; what is undefined or absent is empty."""
    for publication in material.publications:
        row = rows[publication.entry.slug]
        for metric in METRICS:
            for scope in ("overall", "Alpha", "Beta"):
                score = publication.entry.score(metric.name, scope)
                name = f"{metric.name}.{scope}"
                found = {
                    key: value for key, value in row.items() if key in (name, f"{name}.low", f"{name}.high")
                }
                assert list(found) == ([name] if metric.is_p_value else [name, f"{name}.low", f"{name}.high"])
                ends = [score.value, score.low, score.high] if score else [None] * 3
                assert [*found.values()] == ["" if end is None else str(end) for end in ends][: len(found)]


def test_the_table_has_rank_sets(rows: dict[str, dict[str, str]]) -> None:
    """Beside the rank, the ranks that it could be as well; empty where there is none."""
    sets = {slug: (row["rank"], row["rank_low"], row["rank_high"]) for slug, row in rows.items()}
    assert sets["good"] == ("1", "1", "2")
    assert sets["hostile"] == ("3", "3", "3")
    assert sets["part"] == sets["oracle"] == sets["nowhere"] == ("", "", "")


def test_the_table_cannot_run_in_a_spreadsheet(rows: dict[str, dict[str, str]]) -> None:
    """Text that begins like a formula gets an apostrophe; numbers stay numbers."""
    assert rows["hostile"]["name"] == f"'{HOSTILE_NAME}"
    assert rows["hostile"]["team"] == HOSTILE_TEAM
    texts = ("slug", "name", "system", "team", "family", "inputs")
    assert not [row[key] for row in rows.values() for key in texts if row[key].startswith(tuple("=+-@\t\r"))]


def test_the_table_says_that_the_reference_is_synthetic(rows: dict[str, dict[str, str]]) -> None:
    """No row can be quoted as a real figure by mistake."""
    assert {row["reference"] for row in rows.values()} == {"synthetic"}


def test_every_trial_has_a_row(files: dict[str, bytes], material: Material) -> None:
    """In the reference's order, numbered, with what it is and how many of how many people said YES."""
    reference = material.reference
    rows = list(csv.DictReader(io.StringIO(files["trials.csv"].decode())))
    assert [row["trial_id"] for row in rows] == list(reference.trial_ids)
    assert [row["trial"] for row in rows] == [str(number + 1) for number in range(len(rows))]
    assert [row["pair_id"] for row in rows] == [reference.pair_ids[pair] for pair in reference.pairs]
    assert [int(row["label"]) for row in rows] == reference.labels.tolist()
    assert reference.people is not None
    assert [int(row["people"]) for row in rows] == reference.people.n.tolist()
    assert [int(row["people_yes"]) for row in rows] == reference.people.n_yes.tolist()
    assert (rows[0]["property"], rows[0]["scenario"]) == ("Alpha", "alpha_one")


def test_without_people_trials_have_no_counts() -> None:
    """The columns stay, empty."""
    table = render_trials(build_reference(n_people=0))
    assert {tuple(row.split(",")[-2:]) for row in table.splitlines()[1:]} == {("", "")}


def test_json_has_no_blanks(files: dict[str, bytes]) -> None:
    """But for a line of its own for each row of a board."""
    content = files["api/leaderboard.json"].decode()
    rows = sum(len(track["rows"]) for track in json.loads(content)["tracks"])
    assert len(content.splitlines()) > rows
    bare = json.dumps(json.loads(content), ensure_ascii=False, separators=(",", ":"))
    assert content.replace("\n", "") == bare


def test_each_submission_has_its_scores_and_its_place(files: dict[str, bytes], material: Material) -> None:
    """One file holds the metadata, the result as graded, track and rank."""
    for publication in material.publications:
        entry = publication.entry
        data = json.loads(files[f"api/submissions/{entry.slug}.json"])
        assert data["slug"] == entry.slug
        assert data["result"] == json.loads(result_bytes(entry.result))
        assert data["metadata"]["submission"]["name"] == entry.metadata.submission.name
    places = {
        slug: json.loads(files[f"api/submissions/{slug}.json"]) for slug in ("good", "other-track", "oracle")
    }
    assert [(data["track"], data["rank"], data["kind"]) for data in places.values()] == [
        ("with", 1, "ranked"),
        ("without", 1, "ranked"),
        (None, None, "baseline"),
    ]


def test_the_board_file_holds_every_track_and_row(files: dict[str, bytes]) -> None:
    """Boards with rows in order, people's scores, and what each metric is."""
    data = json.loads(files["api/leaderboard.json"])
    assert data["reference"] == {"kind": "synthetic", "digest": "0" * 64}
    assert [metric["name"] for metric in data["metrics"]] == [metric.name for metric in METRICS]
    rows = {track["id"]: [row["slug"] for row in track["rows"]] for track in data["tracks"]}
    assert rows == {
        "with": ["good", "good-too", "hostile", "part", "sliver", "oracle", "flat"],
        "without": ["other-track", "oracle", "flat"],
    }
    assert [row["slug"] for row in data["unplaced"]] == ["nowhere"]
    assert data["people"]["overall"]["all"]["n_rated"] == 24


def test_the_board_file_says_how_sure_ranks_are(files: dict[str, bytes], material: Material) -> None:
    """Rank sets, probabilities of being best, gains, and what can be detected; also in each one's file."""
    with_, without = json.loads(files["api/leaderboard.json"])["tracks"]
    assert with_["detectable_difference"] == {"value": material.boards[0].detectable}
    assert without["detectable_difference"] == {
        "value": None,
        "why": "there are fewer than two different systems",
    }
    rows = {row["slug"]: row for row in with_["rows"]}
    assert (rows["good"]["rank_set"], rows["good"]["best_probability"]) == ([1, 2], 0.5)
    assert (rows["good"]["among_best"], rows["hostile"]["among_best"]) == (True, False)
    assert rows["good"]["property_gain"]["without"] == "other-track"
    assert "rank_set" not in rows["part"]
    own = json.loads(files["api/submissions/good.json"])
    sure = ("rank_set", "best_probability", "among_best", "property_gain")
    assert {key: own[key] for key in sure} == {key: rows["good"][key] for key in sure}


def test_people_are_there_with_their_reliability(files: dict[str, bytes]) -> None:
    """How well they agree, by property and overall, with intervals."""
    people = json.loads(files["api/leaderboard.json"])["people"]
    for scope in ("overall", "Alpha", "Beta"):
        for name in ("split_half_r", "reliability", "reliability_from_counts", "ceiling"):
            assert list(people[scope]["all"][name]) == ["value", "low", "high"]
    assert list(people["overall"]) == list(SUBSETS)


def test_an_unbounded_range_is_null(files: dict[str, bytes]) -> None:
    """JSON knows no infinity."""
    metrics = {m["name"]: m for m in json.loads(files["api/leaderboard.json"])["metrics"]}
    assert (metrics["human_r_normalized"]["low"], metrics["human_r_normalized"]["high"]) == (None, None)
    assert (metrics["accuracy"]["low"], metrics["accuracy"]["high"]) == (0, 1)
    assert b"Infinity" not in files["api/leaderboard.json"]


def test_the_reference_is_described_without_its_labels(files: dict[str, bytes]) -> None:
    """Identity and sizes; nothing that could be learnt from."""
    data = json.loads(files["api/reference.json"])
    assert (data["kind"], data["digest"]) == ("synthetic", "0" * 64)
    assert data["counts"]["all"] == {"trials": 24, "pairs": 12, "rated_trials": 24}
    assert list(data["counts"]) == ["all", "easy", "hard"]
    assert data["people"] == {"participants": 12, "responses": 144}
    assert [(part["name"], part["trials"]) for part in data["properties"]] == [("Alpha", 16), ("Beta", 8)]
    assert [scenario["trials"] for part in data["properties"] for scenario in part["scenarios"]] == [8, 8, 8]
    assert "label" not in files["api/reference.json"].decode()


def test_people_are_counted_as_far_as_they_are_known() -> None:
    """With counts only, nobody knows how many people there were; without human data there were none."""
    counted = build_material(build_reference(responses=False), [])
    assert reference_data(counted)["people"] == {"participants": None, "responses": 144}
    lonely = build_material(build_reference(n_people=0), [])
    assert reference_data(lonely)["people"] == {"participants": None, "responses": 0}


def test_an_empty_board_has_an_empty_table() -> None:
    """The header stays."""
    lines = render_csv(build_material(entries=[])).splitlines()
    assert len(lines) == 1
    assert lines[0].startswith("track,rank,rank_low,rank_high,kind,slug,name,")
