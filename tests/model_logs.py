"""Logs of other tools about the trials of a reference, in the shape in which these tools write them.

Shapes are those of PhysMind (commit 5d39b16), Inspect AI 0.3.285, lm-evaluation-harness 0.4, lmms-eval 0.7.3,
VLMEvalKit, Eureka ML Insights and EvalScope 1.14.1; what does not matter is shortened.
"""

import csv
import io
import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

Json = dict[str, Any]


@dataclass(frozen=True)
class Said:
    """A trial, its true outcome, and what a model said each time it was asked; None is a failed request."""

    trial_id: str
    label: bool
    texts: tuple[str | None, ...]


def word(flag: bool) -> str:
    return "yes" if flag else "no"


def write_lines(file: Path, records: Iterable[Json]) -> Path:
    file.parent.mkdir(parents=True, exist_ok=True)
    text = "".join(json.dumps(record, ensure_ascii=False) + "\n" for record in records)
    file.write_text(text, encoding="utf-8")
    return file


def write_csv(file: Path, rows: Sequence[Mapping[str, object]], *, separator: str = ",") -> Path:
    buffer = io.StringIO()
    writer = csv.DictWriter(buffer, list(rows[0]), delimiter=separator, lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    file.write_text(buffer.getvalue(), encoding="utf-8")
    return file


def write_answers(folder: Path, said: Sequence[Said]) -> Path:
    records = [
        {"video": f"videos/{s.trial_id}_img.mp4", "response": text, "status": "error"}
        if text is None
        else {"video": f"videos/{s.trial_id}_img.mp4", "response": text}
        for s in said
        for text in s.texts
    ]
    return write_lines(folder / "my-model.jsonl", records)


def write_probabilities(folder: Path, said: Sequence[Said]) -> Path:
    rows = [
        {
            "stimulus_id": s.trial_id,
            "p_yes": "" if s.texts[0] is None else f"0.{'75' if s.texts[0] == 'yes' else '250'}",
            "status": "error" if s.texts[0] is None else "",
        }
        for s in said
    ]
    return write_csv(folder / "my-model.csv", rows)


def physmind_question(said: Said) -> Json:
    text = said.texts[0]
    read = text if text in ("yes", "no") else None
    statuses = {word(said.label): "correct", word(not said.label): "wrong_answer"}
    return {
        "question_id": 0,
        "question_type": "ocp",
        "question": "The video ends before the outcome is resolved. [...]",
        "prediction": text and f"<answer>{text}</answer>",
        "raw_prediction": text and f"<answer>{text}</answer>",
        "usage": text and {"input_tokens": 4321, "output_tokens": 12},
        "extracted_answer": text,
        "normalized_prediction": read or "",
        "expected_answer": word(said.label),
        "normalized_expected_answer": word(said.label),
        "ground_truth_outcome": said.label,
        "request_error": text is None,
        "parse_error": text is not None and read is None,
        "error_message": None if text else "Failed on physion_pp scene=3",
        "is_correct": text == word(said.label),
        "status": statuses.get(text, "parse_error") if text else "request_error",
    }


def physmind_scene(index: int, said: Said) -> Json:
    copy_folder, config, number = said.trial_id.split("/")
    scenario, _, copy_name = copy_folder.rpartition("-")
    return {
        "scene_index": index,
        "property": "mass",
        "scenario": scenario,
        "copy_name": copy_name,
        "pair_id": f"{scenario}/{config}/{number}",
        "stimulus_id": f"{scenario}_{config}_{number}",
        "video_filename": f"{index:06d}_cue.mp4",
        "questions": [physmind_question(said)],
    }


def write_physmind(folder: Path, said: Sequence[Said]) -> Path:
    file = folder / "gemini-direct-answer/predictions.json"
    file.parent.mkdir(parents=True)
    scenes = [physmind_scene(index, s) for index, s in enumerate(said)]
    file.write_text(json.dumps(scenes, indent=2), encoding="utf-8")
    return file


def inspect_sample(said: Said, epoch: int, text: str | None) -> Json:
    message = {"content": text, "source": "generate", "role": "assistant", "model": "mockllm/model"}
    choices = [] if text is None else [{"message": message, "stop_reason": "stop"}]
    sample = {
        "id": said.trial_id,
        "epoch": epoch,
        "input": "Will it?",
        "target": word(said.label),
        "messages": [{"content": "Will it?", "source": "input", "role": "user"}],
        "output": {"model": "mockllm/model", "choices": choices, "completion": text or ""},
        "scores": {"match": {"value": "C", "answer": text, "explanation": text, "history": []}},
        "metadata": {"stimulus_id": said.trial_id},
        "store": {},
        "model_usage": {},
    }
    failed = {"message": "RateLimitError('429')", "traceback": "...", "traceback_ansi": "..."}
    return sample if text is not None else sample | {"scores": {}, "error": failed}


def inspect_log(said: Sequence[Said], **changes: object) -> Json:
    n_epochs = max(len(s.texts) for s in said)
    return {
        "version": 2,
        "status": "success",
        "eval": {"task": "physics", "model": "mockllm/model", "packages": {"inspect_ai": "0.3.285"}},
        "plan": {"name": "plan", "steps": []},
        "results": {
            "total_samples": len(said),
            "scores": [{"name": "match", "metrics": {"stderr": float("nan")}}],
        },
        "stats": {},
        "samples": [
            inspect_sample(s, epoch + 1, s.texts[epoch])
            for epoch in range(n_epochs)
            for s in said
            if epoch < len(s.texts)
        ],
        "reductions": [],
    } | changes


def write_inspect(folder: Path, said: Sequence[Said]) -> Path:
    file = folder / "2026-11-21T12-47-04-00-00_physics_UW6SbpFW6cRhU5kbsnV5PF.json"
    file.write_text(json.dumps(inspect_log(said), indent=2), encoding="utf-8")
    return file


def lm_eval_sample(index: int, said: Said, filter_: str, chosen: str | None) -> Json:
    return {
        "doc_id": index,
        "doc": {"stimulus_id": said.trial_id, "question": "Will it?", "label": word(said.label)},
        "target": word(said.label),
        "arguments": {"gen_args_0": {"arg_0": "Will it?", "arg_1": {"until": ["\n\n"], "do_sample": True}}},
        "resps": [list(said.texts)],
        "filtered_resps": [chosen],
        "filter": filter_,
        "metrics": ["exact_match"],
        "doc_hash": "0" * 64,
        "prompt_hash": "1" * 64,
        "target_hash": "2" * 64,
        "exact_match": 1.0,
    }


def lm_eval_file(folder: Path) -> Path:
    return folder / "Qwen__Qwen2.5-VL-7B/samples_physics_2026-11-21T10-00-00.123456.jsonl"


def write_lm_eval(folder: Path, said: Sequence[Said]) -> Path:
    records = [lm_eval_sample(index, s, "none", s.texts[0]) for index, s in enumerate(said)]
    return write_lines(lm_eval_file(folder), records)


def likelihood_sample(index: int, said: Said, yes: str, no: str) -> Json:
    """A document of a multiple-choice task with the choices no and yes; all numbers are texts there."""
    requests = {
        f"gen_args_{k}": {"arg_0": "Will it? Answer:", "arg_1": f" {choice}"}
        for k, choice in enumerate(("no", "yes"))
    }
    responses = [[no, str(float(no) > float(yes))], [yes, str(float(yes) >= float(no))]]
    sample = lm_eval_sample(index, said, "none", None)
    return sample | {
        "target": str(int(said.label)),
        "arguments": requests,
        "resps": [[response] for response in responses],
        "filtered_resps": responses,
    }


def lmms_sample(index: int, said: Said) -> Json:
    texts = list(said.texts)
    return {
        "doc_id": index,
        "target": word(said.label),
        "filtered_resps": texts if len(texts) > 1 else texts[0],
        "token_counts": [{"output_tokens": 3}],
        "doc_hash": "0" * 64,
        "input_media": [f"frames/{said.trial_id}_img.png"],
        "physics_score": {"pred": said.texts[0], "score": 1.0},
        "input": "Will it?",
    }


def write_lmms_eval(folder: Path, said: Sequence[Said]) -> Path:
    file = folder / "llava__onevision/20261121_100000_samples_physics.jsonl"
    return write_lines(file, [lmms_sample(index, s) for index, s in enumerate(said)])


def write_vlmevalkit(folder: Path, said: Sequence[Said]) -> Path:
    failed = "Failed to obtain answer via API."
    rows = [
        {
            "index": s.trial_id,
            "question": "Will it?",
            "answer": word(s.label).title(),
            "prediction": failed if s.texts[0] is None else s.texts[0],
        }
        for s in said
    ]
    return write_csv(folder / "Qwen2.5-VL-7B_Physics.tsv", rows, separator="\t")


def write_eureka(folder: Path, said: Sequence[Said]) -> Path:
    records = [
        {
            "stimulus_id": s.trial_id,
            "ground_truth": word(s.label),
            "prompt": "Will it?",
            "prompt_hash": "0" * 64,
            "uid": index + repeat * len(said),
            "data_point_id": index,
            "data_repeat_id": f"repeat_{repeat}",
            "model_output": text or "",
            "is_valid": text is not None,
            "response_time": 1.25,
            "n_output_tokens": 3,
        }
        for index, s in enumerate(said)
        for repeat, text in enumerate(s.texts)
    ]
    return write_lines(folder / "02_inference/inference_result.jsonl", records)


def evalscope_review(index: int, said: Said, generation: int, text: str | None) -> Json:
    return {
        "index": index,
        "target": [word(said.label)],
        "messages": [{"role": "user", "content": "Will it?"}],
        "agent_trace": None,
        "sample_score": {
            "score": {
                "value": {"acc": 1.0} if text else {},
                "status": "success" if text is not None else "transport_error",
                "extracted_prediction": text,
                "prediction": text,
                "explanation": None,
                "metadata": {},
                "main_score_name": "acc",
            },
            "sample_id": index,
            "group_id": index // len(said.texts),
            "generation_index": generation,
            "sample_metadata": {"video": f"/data/{said.trial_id}_img.mp4"},
        },
    }


def write_evalscope(folder: Path, said: Sequence[Said]) -> Path:
    records = [
        evalscope_review(index * len(s.texts) + generation, s, generation, text)
        for index, s in enumerate(said)
        for generation, text in enumerate(s.texts)
    ]
    return write_lines(folder / "reviews/qwen-vl/physics_default.jsonl", records)


WRITERS: dict[str, Callable[[Path, Sequence[Said]], Path]] = {
    "answers": write_answers,
    "probabilities": write_probabilities,
    "physmind": write_physmind,
    "inspect": write_inspect,
    "lm-eval": write_lm_eval,
    "lmms-eval": write_lmms_eval,
    "vlmevalkit": write_vlmevalkit,
    "eureka": write_eureka,
    "evalscope": write_evalscope,
}

# Tools that can ask a trial more than once, and those that write down a failed request.
WITH_REPEATS = ("answers", "inspect", "lm-eval", "lmms-eval", "eureka", "evalscope")
WITH_ERRORS = tuple(name for name in WRITERS if name not in ("lm-eval", "lmms-eval"))
