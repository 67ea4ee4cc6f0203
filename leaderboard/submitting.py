"""From prediction files and metadata to ``submissions/<slug>/``: complete, valid and graded, or nothing."""

import csv
import datetime as dt
import re
import tomllib
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import tomli_w

from leaderboard.assessing import Assessment, assess
from leaderboard.errors import LeaderboardError, SourceError
from leaderboard.files import hold_folder, read_regular, remove_leftovers, write_atomic, write_folder
from leaderboard.grading import result_bytes
from leaderboard.ids import is_slug
from leaderboard.instance import PREDICTIONS_FILE, RESULT_FILE, SUBMISSION_FILE, Instance
from leaderboard.originality import load_others
from leaderboard.problems import Problem
from leaderboard.reference import Reference
from leaderboard.submission import SIZE_LIMITS, RawFile, RawSubmission
from leaderboard.validation import validate
from leaderboard.validation.translating import TranslatedName, translate_names

Metadata = Mapping[str, Mapping[str, object]]

_BOM = b"\xef\xbb\xbf"


@dataclass(frozen=True)
class PredictionFile:
    """A participant's file: its path as given, and its bytes."""

    path: str
    content: bytes


def suggest_slug(name: str) -> str:
    """Turn a system's name into a slug, or into an empty text where nothing usable is left.

    >>> suggest_slug("Slot Former (v2)"), suggest_slug("ÄLOE"), suggest_slug("模")
    ('slot-former-v2', 'aloe', '')
    """
    plain = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode().lower()
    slug = re.sub(r"[^a-z0-9]+", "-", plain).strip("-")[:64].strip("-")
    return slug if is_slug(slug) else ""


def read_prediction_file(path: Path) -> PredictionFile:
    """Read one prediction file.

    Raises
    ------
    SourceError
        If it is larger than any valid one can be.
    """
    limit = SIZE_LIMITS[PREDICTIONS_FILE]
    content = read_regular(path, limit)
    if content is None:
        raise SourceError(f"{path} is larger than {limit:,} bytes", "a row per trial is all that is needed")
    return PredictionFile(str(path), content)


def read_metadata(path: Path) -> Metadata:
    """Read metadata in the form of ``submission.toml``, whole or in part; its keys are judged later.

    Raises
    ------
    SourceError
        If it is too large, no UTF-8, no TOML, or has keys outside of sections.
    """
    limit = SIZE_LIMITS[SUBMISSION_FILE]
    content = read_regular(path, limit)
    if content is None:
        raise SourceError(f"{path} is larger than {limit:,} bytes", f"is it a {SUBMISSION_FILE}?")
    hint = f"docs/submitting.md shows what a {SUBMISSION_FILE} looks like"
    try:
        sections = tomllib.loads(content.removeprefix(_BOM).decode())
    except UnicodeDecodeError:
        raise SourceError(f"{path}: is not UTF-8 text", hint) from None
    except (ValueError, RecursionError) as error:
        raise SourceError(f"{path}: is not TOML: {error}", hint) from None
    for section, keys in sections.items():
        if not isinstance(keys, dict):
            raise SourceError(f"{path}: {section} stands outside of a section", hint)
    return sections


def translate_files(
    files: Sequence[PredictionFile], reference: Reference
) -> tuple[list[PredictionFile], list[TranslatedName]]:
    """Write trial ids in place of the names that other tools use, and list what was translated."""
    translations = [translate_names(file.content, reference) for file in files]
    translated = [
        replace(file, content=content) for file, (content, _) in zip(files, translations, strict=True)
    ]
    return translated, [name for _, names in translations for name in names]


def add_submission(
    instance: Instance,
    reference: Reference,
    slug: str,
    *,
    metadata: Metadata,
    files: Sequence[PredictionFile],
    today: dt.date,
) -> Assessment:
    """Make a submission's folder from prediction files and metadata.

    The folder is written only if the assessment has no error, and then whole: metadata, predictions and
    result.
    """
    assessment = draft_submission(instance, reference, slug, metadata=metadata, files=files, today=today)
    if assessment.result is not None:
        with hold_folder(instance.submissions_dir):
            remove_leftovers(instance.submissions_dir)
            write_folder(instance.submission_dir(slug), submission_contents(assessment))
    return assessment


def draft_submission(
    instance: Instance,
    reference: Reference,
    slug: str,
    *,
    metadata: Metadata,
    files: Sequence[PredictionFile],
    today: dt.date,
) -> Assessment:
    """Assess what a submission's folder would hold, and write nothing.

    Problems name the participant's own files and lines.
    """
    problems = _judge_slug(instance, slug) + _judge_parts(files, reference, today)
    toml = render_metadata(metadata)
    raw = _assemble(instance, slug, toml, merge_predictions(files) if not problems else b"")
    others = load_others(instance, raw, reference, today=today)
    assessment = assess(raw, reference, today=today, others=others)
    found = tuple(
        _point_to_origin(p, files) for p in assessment.problems if not (problems and _is_of_file(p))
    )
    assessment = replace(assessment, problems=(*problems, *found))
    if assessment.result is None or problems:
        return replace(assessment, submission=None, result=None)
    return assessment


def replace_submission(
    instance: Instance,
    reference: Reference,
    slug: str,
    metadata: bytes,
    predictions: bytes,
    *,
    today: dt.date,
) -> None:
    """Write a generated submission with its result, over an older one of the same slug if there is one.

    Raises
    ------
    LeaderboardError
        If what was generated is not valid; nothing is written then.
    """
    raw = _assemble(instance, slug, metadata, predictions)
    assessment = assess(raw, reference, today=today)
    if assessment.result is None:
        raise LeaderboardError(f"generated submission {slug} is not valid: {assessment.problems[0].message}")
    contents = submission_contents(assessment)
    folder = instance.submission_dir(slug)
    instance.submissions_dir.mkdir(parents=True, exist_ok=True)
    with hold_folder(instance.submissions_dir):
        remove_leftovers(instance.submissions_dir)
        if not folder.exists():
            write_folder(folder, contents)
            return
        remove_leftovers(folder)
        for name, content in contents.items():
            write_atomic(folder / name, content)


def submission_contents(assessment: Assessment) -> dict[str, bytes]:
    """Map the names of a graded submission's files to their bytes."""
    contents = {file.name: file.content for file in assessment.raw.files if file.content is not None}
    if assessment.result is not None:
        contents[RESULT_FILE] = result_bytes(assessment.result)
    return contents


def render_metadata(metadata: Metadata) -> bytes:
    """Write metadata as ``submission.toml``, leaving out what is None and sections without content."""
    kept = {
        section: {key: value for key, value in values.items() if value is not None}
        for section, values in metadata.items()
    }
    return tomli_w.dumps({section: values for section, values in kept.items() if values}).encode()


def merge_predictions(files: Sequence[PredictionFile]) -> bytes:
    """Join prediction files with equal headers into one; a single file stays as it is, byte for byte."""
    if len(files) == 1:
        return files[0].content
    header, _ = _split_header(files[0].content)
    bodies = [_split_header(file.content)[1] for file in files]
    return b"".join([header, b"\n", *(body if body.endswith(b"\n") else body + b"\n" for body in bodies)])


def _assemble(instance: Instance, slug: str, toml: bytes, predictions: bytes) -> RawSubmission:
    contents = {PREDICTIONS_FILE: predictions, SUBMISSION_FILE: toml}
    files = tuple(RawFile(name, "file", len(content), content) for name, content in contents.items())
    return RawSubmission(instance.display_path(instance.submission_dir(slug)), slug, files)


def _judge_slug(instance: Instance, slug: str) -> tuple[Problem, ...]:
    where = f"submissions/{slug}"
    if is_slug(slug) and instance.submission_dir(slug).exists():
        hint = "choose another slug; a published submission is never replaced"
        return (Problem("slug-taken", f"there is a submission {slug} already", where, None, hint),)
    return ()


def _judge_parts(
    files: Sequence[PredictionFile], reference: Reference, today: dt.date
) -> tuple[Problem, ...]:
    """Find what is wrong with single files and between them, where several are to be joined."""
    if len(files) == 1:
        return ()
    problems = [
        problem
        for file in files
        for problem in validate(_as_bare(file), reference, today=today).problems
        if problem.is_error and problem.code != "missing-trials"
    ]
    if problems:
        return tuple(problems)
    return tuple(_compare_headers(files)) or tuple(_find_repeated(files))


def _compare_headers(files: Sequence[PredictionFile]) -> Iterable[Problem]:
    first = _split_header(files[0].content)[0]
    for file in files[1:]:
        header = _split_header(file.content)[0]
        if header != first:
            message = f"the columns {header.decode()} differ from {first.decode()} in {files[0].path}"
            yield Problem("wrong-header", message, file.path, 1, "give all files the same columns")


def _find_repeated(files: Sequence[PredictionFile]) -> Iterable[Problem]:
    seen: dict[str, tuple[str, int]] = {}
    for file in files:
        rows = csv.reader(_split_header(file.content)[1].decode().splitlines())
        for line, row in enumerate(rows, 2):
            path, earlier = seen.setdefault(row[0], (file.path, line))
            if path != file.path:
                message = f"trial {row[0]} is also in {path}, line {earlier}"
                yield Problem("duplicate-trial", message, file.path, line, "keep one of the two")


def _as_bare(file: PredictionFile) -> RawSubmission:
    raw = RawFile(PREDICTIONS_FILE, "file", len(file.content), file.content)
    return RawSubmission(file.path, None, (raw,))


def _is_of_file(problem: Problem) -> bool:
    return problem.file.endswith(PREDICTIONS_FILE)


def _point_to_origin(problem: Problem, files: Sequence[PredictionFile]) -> Problem:
    """Name the participant's file, or the metadata, instead of a file that is not written yet."""
    if _is_of_file(problem):
        if len(files) == 1:
            return replace(problem, file=files[0].path)
        return replace(problem, file=", ".join(file.path for file in files), line=None)
    if problem.file.endswith(SUBMISSION_FILE):
        return replace(problem, file="metadata", line=None)
    return problem


def _split_header(content: bytes) -> tuple[bytes, bytes]:
    header, _, body = content.removeprefix(_BOM).partition(b"\n")
    return header.removesuffix(b"\r"), body
