"""What each format has that the others have not, and what is refused in it."""

import json
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

from leaderboard.converting import FORMATS, Options
from leaderboard.converting.answer_tables import ANSWER_FIELDS, REPEAT_FIELDS
from leaderboard.converting.log import Answer, Run
from leaderboard.converting.probability_tables import LOGIT_FIELDS, PROBABILITY_FIELDS
from leaderboard.converting.records import ID_FIELDS, TRUTH_FIELDS
from leaderboard.errors import SourceError
from leaderboard.submission import Status
from model_logs import (
    WRITERS,
    Said,
    evalscope_review,
    inspect_log,
    likelihood_sample,
    lm_eval_file,
    lm_eval_sample,
    lmms_sample,
    physmind_scene,
    write_lines,
)

TRIAL = "alpha_one-copy0/set=a,b/0000"
OTHER = "alpha_one-copy1/set=a,b/0000"
FIXTURES = Path(__file__).parent / "fixtures"


def said(*texts: str | None, trial_id: str = TRIAL) -> Said:
    return Said(trial_id, label=True, texts=texts or ("yes",))


def read(name: str, *files: Path, **options: Any) -> list[Run]:
    return list(FORMATS[name].read_runs(files, Options(**options)))


def read_one(name: str, file: Path, **options: Any) -> tuple[Answer, ...]:
    (run,) = read(name, file, **options)
    return run.answers


def write_text(folder: Path, name: str, text: str) -> Path:
    (folder / name).write_text(text, encoding="utf-8")
    return folder / name


def refusal(call: Callable[[], object], folder: Path) -> tuple[str, str]:
    """What the refusal says, without the folder, and its hint."""
    with pytest.raises(SourceError) as caught:
        call()
    return caught.value.message.replace(f"{folder}/", ""), caught.value.hint


class TestAnswers:
    """Any table or JSON lines with an id and a text."""

    def test_fields_are_found_or_named(self, tmp_path: Path) -> None:
        """The usual names are found; a dot leads into an object where they are said."""
        line = json.dumps({"meta": {"clip": TRIAL}, "answer": "truth", "say": {"text": "no"}})
        file = write_text(tmp_path, "log.jsonl", line + "\n")
        (answer,) = read_one("answers", file, id_field="meta.clip", answer_field="say.text")
        assert (answer.trial_name, answer.probability, answer.place) == (TRIAL, "0", "log.jsonl:1")

    def test_path_counts_before_a_number(self, tmp_path: Path) -> None:
        """Where rows are numbered and name their video, the video is the trial."""
        line = json.dumps({"id": 17, "video": f"videos/{TRIAL}_img.mp4", "answer": "no"})
        (answer,) = read_one("answers", write_text(tmp_path, "log.jsonl", line + "\n"))
        assert answer.trial_name == f"videos/{TRIAL}_img.mp4"

    def test_two_possible_answers_are_not_guessed_between(self, tmp_path: Path) -> None:
        """Where a log has an answer and a prediction, one of them may be the truth."""
        file = write_text(tmp_path, "log.csv", f'id,answer,prediction\n"{TRIAL}",yes,no\n')
        assert refusal(lambda: read("answers", file), tmp_path) == (
            "log.csv:2: has the fields answer and prediction",
            "say with --answer-field which it is",
        )
        assert read_one("answers", file, answer_field="prediction")[0].probability == "0"

    def test_numbered_repeats_may_not_come_twice(self, tmp_path: Path) -> None:
        """A field repeat or epoch tells repeats apart; without it, every row is one."""
        rows = f'"{TRIAL}",yes,1\n"{TRIAL}",no,1\n'
        numbered = read_one("answers", write_text(tmp_path, "a.csv", f"id,answer,epoch\n{rows}"))
        assert [answer.repeat for answer in numbered] == ["1", "1"]
        unnumbered = read_one("answers", write_text(tmp_path, "b.csv", f"id,answer,cost\n{rows}"))
        assert len({answer.repeat for answer in unnumbered}) == 2

    @pytest.mark.parametrize(
        ("field", "truth", "outcome"),
        [
            ("target", "yes", True),
            ("label", 0, False),
            ("label", "1", True),
            ("ground_truth", True, True),
            ("label", "will hit", None),
            ("label", None, None),
            ("gold", "yes", None),
        ],
    )
    def test_truth_beside_an_answer_is_taken(
        self, tmp_path: Path, field: str, truth: object, outcome: bool | None
    ) -> None:
        """An outcome in a usual field, as YES and NO or 1 and 0, can be held against the label."""
        for name, said in (("answers", {"answer": "no"}), ("probabilities", {"p_yes": 0.5})):
            line = json.dumps({"id": TRIAL, field: truth, **said})
            (answer,) = read_one(name, write_text(tmp_path, "log.jsonl", line + "\n"))
            assert answer.outcome is outcome

    def test_what_is_the_answer_is_not_the_truth(self, tmp_path: Path) -> None:
        """A usual field of the truth may be said to hold the answer."""
        line = json.dumps({"id": TRIAL, "label": "no", "target": "yes"})
        (answer,) = read_one("answers", write_text(tmp_path, "a.jsonl", line + "\n"), answer_field="label")
        assert (answer.probability, answer.outcome) == ("0", True)

    @pytest.mark.parametrize(
        ("name", "cells"), [("answers", "answer\nyes no"), ("probabilities", "p_yes\n1 0")]
    )
    def test_each_model_is_a_run(self, tmp_path: Path, name: str, cells: str) -> None:
        """Rows of several models are no repeats of one; a model that all rows name changes nothing."""
        field, first, second = cells.split()
        rows = f'"{TRIAL}",{first},b/2\n"{TRIAL}",{second},a\n'
        both = read(name, write_text(tmp_path, "log.csv", f"id,{field},model\n{rows}"))
        assert [(run.name, run.answers[0].probability) for run in both] == [("log-a", "0"), ("log-b-2", "1")]
        same = read(name, write_text(tmp_path, "log.csv", f"id,{field},model\n{rows.replace('b/2', 'a')}"))
        assert [(run.name, len(run.answers)) for run in same] == [("log", 2)]

    def test_json_list_and_null_are_read(self, tmp_path: Path) -> None:
        """A list of objects will do; no text is no answer, and a map gives the trial of a bare number."""
        file = write_text(tmp_path, "log.json", json.dumps([{"id": 7, "answer": None}]))
        (answer,) = read_one("answers", file, id_map={"7": TRIAL})
        assert (answer.trial_name, answer.status, answer.place) == (
            TRIAL,
            Status.UNPARSABLE,
            "log.json, record 1",
        )

    @pytest.mark.parametrize(
        ("name", "text", "message"),
        [
            (
                "a.jsonl",
                '{"id": "a", "answer": "yes"}\n{"id": "b"',
                "a.jsonl:2: is no JSON: Expecting ',' delimiter at column 11",
            ),
            ("a.jsonl", '{"id": "a", "id": "b"}', "a.jsonl:1: has the key 'id' twice in an object"),
            ("a.jsonl", '{"id": "a", "answer": NaN}', "a.jsonl:1: holds NaN, which is no number of JSON"),
            ("a.jsonl", '{"id": ' + "[" * 100_000, "a.jsonl:1: is nested too deeply to be a log"),
            ("a.jsonl", '["a", "yes"]', "a.jsonl:1: is a list, not an object"),
            ("a.jsonl", '{"id": "a", "answer": "yes"}\n\n{"id": "b"}', "a.jsonl:2: the line is blank"),
            ("a.jsonl", "", "a.jsonl: is empty"),
            ("a.jsonl", '{"id": "a", "answer": ["yes"]}', "a.jsonl:1: answer is \"['yes']\", not a text"),
            (
                "a.jsonl",
                '{"id": "", "answer": "yes"}',
                "a.jsonl:1: id is empty where a trial should be named",
            ),
            (
                "a.jsonl",
                '{"id": true, "answer": "yes"}',
                "a.jsonl:1: id is 'True' where a trial should be named",
            ),
            ("a.jsonl", '{"id": "a", "answer": "yes", "status": "ok"}', "a.jsonl:1: status 'ok' is unknown"),
            ("a.json", '{"id": "a"}', "a.json: holds an object where a list of records should be"),
            ("a.json", "[]", "a.json: has no records"),
            ("a.csv", "id,answer\n", "a.csv: holds a header but no rows"),
            ("a.csv", "id,answer\na\n", "a.csv:2: has 1 cell where the header has 2"),
            ("a.xlsx", "PK", "a.xlsx: is none of .jsonl, .ndjson, .json, .csv, .tsv, to judge by its name"),
        ],
    )
    def test_hostile_files_are_refused(self, tmp_path: Path, name: str, text: str, message: str) -> None:
        """The message says which file and line, and what is wrong there."""
        file = write_text(tmp_path, name, text)
        assert refusal(lambda: read("answers", file), tmp_path)[0] == message

    def test_fields_that_are_missing_are_named(self, tmp_path: Path) -> None:
        """The fields that are there are listed."""
        file = write_text(tmp_path, "log.jsonl", '{"name": "a", "answer": "yes"}')
        message, hint = refusal(lambda: read("answers", file), tmp_path)
        assert message.startswith("log.jsonl:1: has none of the fields trial_id, stimulus_id, ")
        assert hint == "say with --id-field; there are 'answer, name'"
        message, _ = refusal(lambda: read("answers", file, id_field="clip"), tmp_path)
        assert message == "log.jsonl:1: has no field 'clip'; there are 'answer, name'"

    def test_unreadable_bytes_are_refused(self, tmp_path: Path) -> None:
        """Other encodings than UTF-8 are named with the byte."""
        (tmp_path / "log.jsonl").write_bytes(b'{"id": "a", "answer": "\xff"}')
        message, _ = refusal(lambda: read("answers", tmp_path / "log.jsonl"), tmp_path)
        assert message == "log.jsonl:1: is not UTF-8 text (byte 0xff)"
        message, _ = refusal(lambda: read("answers", tmp_path / "none.jsonl"), tmp_path)
        assert message == "none.jsonl: cannot be read: No such file or directory"

    def test_huge_files_are_refused(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        """A file beyond the limit is not read at all."""
        monkeypatch.setattr("leaderboard.converting.json_logs.SIZE_LIMIT", 10)
        file = write_text(tmp_path, "log.jsonl", '{"id": "a", "answer": "yes"}')
        assert refusal(lambda: read("answers", file), tmp_path) == (
            "log.jsonl: is larger than 10 bytes",
            "is it the right file?",
        )

    def test_maps_give_each_id_once(self, tmp_path: Path) -> None:
        """A map that says two things of one id is refused."""
        from leaderboard.converting import read_id_map

        file = write_text(tmp_path, "map.csv", f'log_id,trial_id\n1,"{TRIAL}"\n1,"{OTHER}"\n')
        assert refusal(lambda: read_id_map(file), tmp_path)[0] == "map.csv:3: log_id '1' is given twice"


class TestProbabilities:
    """Any table or JSON lines with an id and a number."""

    @pytest.mark.parametrize("cell", ["0.25", "1", "1e-05", "0.250000000001"])
    def test_digits_are_kept(self, tmp_path: Path, cell: str) -> None:
        """A probability is written as it stands."""
        file = write_text(tmp_path, "p.csv", f'id,probability\n"{TRIAL}",{cell}\n')
        assert read_one("probabilities", file)[0].probability == cell

    @pytest.mark.parametrize("cell", ["1.01", "-0.1", "nan", "inf", "50%", "", "0x1", "1e400", "yes"])
    def test_other_cells_are_refused(self, tmp_path: Path, cell: str) -> None:
        """What is no number from 0 to 1 is refused with its line."""
        file = write_text(tmp_path, "p.csv", f'id,probability\n"{TRIAL}",{cell}\n')
        message, _ = refusal(lambda: read("probabilities", file), tmp_path)
        assert message == f"p.csv:2: probability is {cell!r}, not a number from 0 to 1"

    def test_numbers_of_json_are_read(self, tmp_path: Path) -> None:
        """Numbers and texts alike; true is none, and a logit must be finite."""
        lines: list[dict[str, Any]] = [{"id": TRIAL, "p_yes": 0.125}, {"id": OTHER, "p_yes": "0.5"}]
        file = write_lines(tmp_path / "p.jsonl", lines)
        assert [answer.probability for answer in read_one("probabilities", file)] == ["0.125", "0.5"]
        file = write_lines(tmp_path / "p.jsonl", [{"id": TRIAL, "p_yes": True}])
        assert "p_yes is 'True'" in refusal(lambda: read("probabilities", file), tmp_path)[0]
        file = write_lines(tmp_path / "p.jsonl", [{"id": TRIAL, "logit": "1e999"}])
        message, _ = refusal(lambda: read("probabilities", file, is_logit=True), tmp_path)
        assert message == "p.jsonl:1: logit is '1e999', not a finite number"


class TestPhysmind:
    """Scenes with one question each."""

    def write(self, folder: Path, scene: dict[str, Any]) -> Path:
        return write_text(folder, "run.json", json.dumps({"schema_version": 1, "predictions": [scene]}))

    def test_copy_comes_from_the_pair(self, tmp_path: Path) -> None:
        """The trial is named by pair and copy, since the name of a video may be that of both."""
        (answer,) = read_one("physmind", self.write(tmp_path, physmind_scene(3, said(trial_id=OTHER))))
        assert (answer.trial_name, answer.scenario_name) == (OTHER, "alpha_one")
        assert (answer.outcome, answer.place) == (True, "run.json, scene 1")
        scene = physmind_scene(3, said()) | {"pair_id": ""}
        (answer,) = read_one("physmind", self.write(tmp_path, scene))
        assert answer.trial_name == "alpha_one_set=a,b_0000"

    def test_text_counts_before_its_own_reading(self, tmp_path: Path) -> None:
        """PhysMind reads the first tag: a difference is a doubt; its reading stands only without a text."""
        scene = physmind_scene(0, said("yes"))
        scene["questions"][0] |= {"raw_prediction": "Yes? No.\nFinal answer: no"}
        (answer,) = read_one("physmind", self.write(tmp_path, scene))
        assert answer.probability == "0"
        assert answer.doubts == ("says NO, and was read as YES by PhysMind",)
        scene["questions"][0] |= {"raw_prediction": "<answer>yes</answer> or <answer>no</answer>"}
        (answer,) = read_one("physmind", self.write(tmp_path, scene))
        assert answer.status is Status.UNPARSABLE
        assert answer.doubts == ("says neither YES nor NO, and was read as YES by PhysMind",)
        scene["questions"][0] |= {"raw_prediction": None}
        (answer,) = read_one("physmind", self.write(tmp_path, scene))
        assert (answer.probability, answer.doubts) == ("1", ())

    @pytest.mark.parametrize(
        ("change", "message"),
        [
            ({"questions": []}, "run.json, scene 1: has 0 questions where one is needed"),
            ({"questions": None}, "run.json, scene 1: lacks questions"),
            ({"questions": "no"}, "run.json, scene 1: questions is \"'no'\", not a list"),
            (
                {"questions": [{"status": "fine"}]},
                (
                    "run.json, scene 1: status 'fine' is none of "
                    "correct, wrong_answer, parse_error, request_error"
                ),
            ),
        ],
    )
    def test_other_scenes_are_refused(self, tmp_path: Path, change: dict[str, Any], message: str) -> None:
        """The message names the scene by its number."""
        file = self.write(tmp_path, physmind_scene(0, said()) | change)
        assert refusal(lambda: read("physmind", file), tmp_path)[0] == message

    @pytest.mark.parametrize(
        ("content", "message"),
        [
            ({"schema_version": 1}, "run.json: has no predictions, so it is no run of PhysMind"),
            ({"predictions": None}, "run.json: holds null where a list of scenes should be"),
            ("yes", "run.json: holds a text where a list of scenes should be"),
        ],
    )
    def test_files_without_scenes_are_refused(self, tmp_path: Path, content: object, message: str) -> None:
        """What is not there is not called null."""
        file = write_text(tmp_path, "run.json", json.dumps(content))
        assert refusal(lambda: read("physmind", file), tmp_path)[0] == message


class TestInspect:
    """Logs in JSON, and in the package's own format through the package."""

    def test_real_log_is_read(self) -> None:
        """A log that Inspect AI 0.3.285 wrote: two samples, two epochs, one of which failed."""
        (run,) = read("inspect", FIXTURES / "inspect_log.json")
        found = [(a.trial_name, a.repeat, a.probability, a.status.value, a.outcome) for a in run.answers]
        first, second = "a-copy0/x/0000", "a-copy1/x/0000"
        assert run.name == "mockllm-model"
        assert found == [
            (first, "epoch 1", "1", "answered", True),
            (second, "epoch 1", "0", "answered", False),
            (first, "epoch 2", "0", "answered", True),
            (second, "epoch 2", "", "error", False),
        ]

    def test_filtered_content_is_a_refusal(self, tmp_path: Path) -> None:
        """An answer that the provider held back is a refusal, whatever is left of it."""
        log = inspect_log([said("yes")])
        log["samples"][0]["output"]["choices"][0]["stop_reason"] = "content_filter"
        (answer,) = read_one("inspect", write_text(tmp_path, "log.json", json.dumps(log)))
        assert answer.status is Status.REFUSED

    def test_models_are_runs(self, tmp_path: Path) -> None:
        """Logs of one model are joined; another model is another run."""
        logs = [
            inspect_log([said()]),
            inspect_log([said(trial_id=OTHER)]),
            inspect_log([said()], eval={"model": "b/c"}),
        ]
        files = [write_text(tmp_path, f"{k}.json", json.dumps(log)) for k, log in enumerate(logs)]
        assert {run.name: len(run.answers) for run in read("inspect", *files)} == {
            "b-c": 1,
            "mockllm-model": 2,
        }

    @pytest.mark.parametrize(
        ("change", "message"),
        [
            ({"status": "error"}, "log.json: the evaluation has the status 'error', not success"),
            ({"invalidated": True}, "log.json: samples of the evaluation were marked as invalid"),
            ({"eval": {}}, "log.json: has no eval.model or no samples, so it is no log of Inspect AI"),
            ({"samples": None}, "log.json: holds null where a list of samples should be"),
            ({"samples": [3]}, "log.json, sample 1: is a number, not an object"),
        ],
    )
    def test_other_logs_are_refused(self, tmp_path: Path, change: dict[str, Any], message: str) -> None:
        """An evaluation that broke off is no result."""
        file = write_text(tmp_path, "log.json", json.dumps(inspect_log([said()], **change)))
        assert refusal(lambda: read("inspect", file), tmp_path)[0] == message

    def test_own_format_needs_the_package(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        """Without it the message says how to get it, or around it."""
        monkeypatch.setitem(sys.modules, "inspect_ai.log", None)
        file = write_text(tmp_path, "log.eval", "PK")
        assert refusal(lambda: read("inspect", file), tmp_path) == (
            "log.eval: a log in the format eval needs the package inspect_ai",
            "pip install inspect_ai, or: inspect log convert --to json --output-dir DIR LOG",
        )

    def test_own_format_is_read_by_the_package(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        """What the package reads counts as the log in JSON does; what it cannot read is refused."""

        def read_eval_log(name: str) -> SimpleNamespace:
            if name.endswith("broken.eval"):
                raise ValueError("not a zip file")
            return SimpleNamespace(model_dump_json=lambda: json.dumps(inspect_log([said("no")])))

        package = ModuleType("inspect_ai.log")
        package.__dict__["read_eval_log"] = read_eval_log
        monkeypatch.setitem(sys.modules, "inspect_ai", ModuleType("inspect_ai"))
        monkeypatch.setitem(sys.modules, "inspect_ai.log", package)
        assert read_one("inspect", tmp_path / "log.eval")[0].probability == "0"
        message, _ = refusal(lambda: read("inspect", tmp_path / "broken.eval"), tmp_path)
        assert message == "broken.eval: inspect_ai cannot read it: 'not a zip file'"


class TestLmEval:
    """Samples with filters, or with log-likelihoods."""

    def test_filters_are_runs(self, tmp_path: Path) -> None:
        """Each filter is a run: none passes all responses on as repeats, another chooses one."""
        records = [
            lm_eval_sample(0, said("yes", "no", "yes"), "none", "yes"),
            lm_eval_sample(0, said("yes", "no", "yes"), "strict-match", "[invalid]"),
        ]
        runs = read("lm-eval", write_lines(lm_eval_file(tmp_path), records))
        assert {run.name: [answer.probability for answer in run.answers] for run in runs} == {
            "qwen-qwen2-5-vl-7b-none": ["1", "0", "1"],
            "qwen-qwen2-5-vl-7b-strict-match": [""],
        }

    def test_likelihoods_give_real_probabilities(self, tmp_path: Path) -> None:
        """P(YES) among the two choices, whichever comes first, and the truth by its position."""
        record = likelihood_sample(0, said(), yes="-0.5", no="-1.5")
        (run,) = read("lm-eval", write_lines(lm_eval_file(tmp_path), [record]))
        assert float(run.answers[0].probability) == pytest.approx(1 / (1 + 2.718281828459045**-1))
        assert (run.answers[0].outcome, run.reader) == (True, None)

    def test_flags_may_be_no_texts(self, tmp_path: Path) -> None:
        """Versions that write numbers and flags as such are read likewise."""
        record = likelihood_sample(0, said(), yes="-0.5", no="-1.5")
        record["filtered_resps"] = [[-1.5, False], [-0.5, True]]
        (answer,) = read_one("lm-eval", write_lines(lm_eval_file(tmp_path), [record]))
        assert float(answer.probability) == pytest.approx(1 / (1 + 2.718281828459045**-1))

    @pytest.mark.parametrize(
        ("change", "message"),
        [
            (
                {
                    "arguments": {
                        "gen_args_0": {"arg_0": "?", "arg_1": " A"},
                        "gen_args_1": {"arg_0": "?", "arg_1": " B"},
                    }
                },
                "the choices are ' A,  B'; they must be one YES and one NO",
            ),
            (
                {"filtered_resps": [["nan", "True"], ["-1", "False"]]},
                "the log-likelihood 'nan' is no finite number",
            ),
            (
                {"filtered_resps": [["x", "True"], ["-1", "False"]]},
                "the log-likelihood 'x' is no finite number",
            ),
            ({"filtered_resps": None}, "lacks filtered_resps"),
            ({"filtered_resps": [3], "filter": "x"}, "answer 1 is '3', not a text"),
        ],
    )
    def test_other_samples_are_refused(self, tmp_path: Path, change: dict[str, Any], message: str) -> None:
        """Choices that are not YES and NO mean nothing here."""
        record = likelihood_sample(0, said(), yes="-0.5", no="-1.5") | change
        file = write_lines(tmp_path / "samples.jsonl", [record])
        assert refusal(lambda: read("lm-eval", file), tmp_path)[0] == f"samples.jsonl:1: {message}"


class TestLmmsEval:
    """Samples without their document."""

    def test_appended_answers_are_duplicates(self, tmp_path: Path) -> None:
        """A run begun again appends: both rows stand for the same repeat."""
        file = write_lines(tmp_path / "m/s.jsonl", [lmms_sample(0, said()), lmms_sample(0, said("no"))])
        assert [(answer.repeat, answer.probability) for answer in read_one("lmms-eval", file)] == [
            ("1", "1"),
            ("1", "0"),
        ]

    def test_repeats_are_in_the_responses(self, tmp_path: Path) -> None:
        """Where a filter chose the first of several answers, all of them count; else what it made of one."""
        sample = lmms_sample(0, said("yes"))
        several = sample | {"resps": ["yes", "no", "yes"], "filtered_resps": "yes"}
        stripped = sample | {"resps": "<think>no</think>yes", "filtered_resps": "yes"}
        file = write_lines(tmp_path / "m/s.jsonl", [several, stripped])
        assert [(answer.repeat, answer.probability) for answer in read_one("lmms-eval", file)] == [
            ("1", "1"),
            ("2", "0"),
            ("3", "1"),
            ("1", "1"),
        ]

    def test_names_come_from_a_map_or_a_field(self, tmp_path: Path) -> None:
        """Where the media do not name the trial, doc_id and a map do, or any field that is said."""
        sample = lmms_sample(7, said()) | {"input_media": ["a.png", "b.png"], "score": {"clip": OTHER}}
        file = write_lines(tmp_path / "s.jsonl", [sample])
        assert read_one("lmms-eval", file, id_map={"7": TRIAL})[0].trial_name == TRIAL
        assert read_one("lmms-eval", file, id_field="score.clip")[0].trial_name == OTHER
        message, hint = refusal(lambda: read("lmms-eval", file), tmp_path)
        assert message == (
            "s.jsonl:1: has the input_media \"['a.png', 'b.png']\", where one file would name the trial"
        )
        assert hint.startswith("give --id-map FILE with the columns log_id (doc_id here) and trial_id")


class TestOtherFormats:
    """VLMEvalKit, Eureka and EvalScope."""

    def test_truth_of_vlmevalkit_is_not_taken_for_the_answer(self, tmp_path: Path) -> None:
        """The column answer is the truth; a file before inference has no prediction and is refused."""
        file = WRITERS["vlmevalkit"](tmp_path, [said("no")])
        (answer,) = read_one("vlmevalkit", file)
        assert (answer.probability, answer.outcome) == ("0", True)
        file = write_text(tmp_path, "t.tsv", f"index\tanswer\n{TRIAL}\tyes\n")
        assert refusal(lambda: read("vlmevalkit", file), tmp_path)[0] == (
            "t.tsv:2: lacks prediction, so it is no table of VLMEvalKit's inference"
        )

    def test_sheet_is_to_be_saved_as_csv(self, tmp_path: Path) -> None:
        """A spreadsheet gets a hint."""
        file = write_text(tmp_path, "m_d.xlsx", "PK")
        assert refusal(lambda: read("vlmevalkit", file), tmp_path)[1] == "save the sheet as CSV"

    def test_validity_of_eureka_is_needed(self, tmp_path: Path) -> None:
        """A result without is_valid is no result, nor is one in which it is a word."""
        for given, expected in (
            ({}, "lacks is_valid, which says whether the model gave an output"),
            ({"is_valid": None}, "lacks is_valid, which says whether the model gave an output"),
            ({"is_valid": "yes"}, "is_valid is \"'yes'\", neither true nor false"),
        ):
            result = {"stimulus_id": TRIAL, "model_output": "yes"} | given
            file = write_lines(tmp_path / "r.jsonl", [result])
            message, _ = refusal(partial(read, "eureka", file), tmp_path)
            assert message == f"r.jsonl:1: {expected}"

    def test_reviews_are_named_by_metadata_or_map(self, tmp_path: Path) -> None:
        """Without metadata, the group of a sample's repeats or its index is looked up in a map."""
        review = evalscope_review(4, said("yes", "no"), 1, "no")
        review["sample_score"]["sample_metadata"] = None
        file = write_lines(tmp_path / "m/r.jsonl", [review])
        assert read_one("evalscope", file, id_map={"2": TRIAL})[0].trial_name == TRIAL
        del review["sample_score"]["group_id"], review["sample_score"]["generation_index"]
        (answer,) = read_one("evalscope", write_lines(file, [review]), id_map={"4": TRIAL})
        assert (answer.trial_name, answer.repeat) == (TRIAL, "index 4")
        message, _ = refusal(lambda: read("evalscope", file), tmp_path)
        assert message == "m/r.jsonl:1: its sample_metadata names no trial"

    def test_other_lines_are_no_reviews(self, tmp_path: Path) -> None:
        """Predictions of EvalScope have no score, and are not what is asked for."""
        file = write_lines(tmp_path / "p.jsonl", [{"index": 0, "model": "m"}])
        message, _ = refusal(lambda: read("evalscope", file, id_map={"0": TRIAL}), tmp_path)
        assert message == "p.jsonl:1: lacks sample_score.score, so it is no review of EvalScope"


@pytest.mark.parametrize("name", FORMATS)
def test_fields_that_are_read_are_documented(name: str, repo_root: Path) -> None:
    """The guide has a row for each format, and those of the general ones list every usual field."""
    docs = (repo_root / "docs/converting.md").read_text(encoding="utf-8")
    (row,) = (line for line in docs.splitlines() if line.startswith(f"| `{name}` |"))
    usual = {
        "answers": (*ID_FIELDS, *ANSWER_FIELDS, *REPEAT_FIELDS, *TRUTH_FIELDS),
        "probabilities": (*PROBABILITY_FIELDS, *LOGIT_FIELDS),
    }
    assert [field for field in usual.get(name, ()) if f"`{field}`" not in row] == []


def test_runs_of_one_name_are_refused(tmp_path: Path) -> None:
    """Two models whose names differ only in what a slug cannot hold are not thrown together."""
    from builders import build_reference

    samples = [lmms_sample(0, said())]
    files = [write_lines(tmp_path / model / "s.jsonl", samples) for model in ("a_b", "a-b")]
    message, _ = refusal(lambda: FORMATS["lmms-eval"].split_runs(files, build_reference(2)), tmp_path)
    assert message == "a_b/s.jsonl: two runs would be named a-b"
