"""``leaderboard submit`` with metadata in a file."""

import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

Run = Callable[..., Result]

PART = """\
[submission]
name = "My Model"
team = "My Lab"
date = 2026-11-20
description = "A test."

[protocol]
training = "separate"
selection = "readout"

[contact]
github = "someone"
"""
REST = ("--testing=with_property", "--family=video", "--inputs=rgb")


@pytest.fixture
def submit(run: Run, example: Path, tmp_path: Path) -> Callable[..., Result]:
    """Submit the example's predictions with a file of metadata."""

    def submit_with(toml: str | bytes, *options: str, exit_code: int = 0) -> Result:
        file = tmp_path / "metadata.toml"
        file.write_bytes(toml.encode() if isinstance(toml, str) else toml)
        arguments = ("submit", example / "predictions.csv", "--metadata", file, *options)
        return run(*arguments, exit_code=exit_code)

    return submit_with


def read_written(root: Path, slug: str = "my-model") -> dict[str, Any]:
    return tomllib.loads((root / "submissions" / slug / "submission.toml").read_text())


def test_a_part_may_stand_in_a_file(submit: Callable[..., Result], root: Path) -> None:
    """What the file says need not be said again, and name and system follow from it."""
    submit(PART, *REST)
    written = read_written(root)
    assert written["submission"] == {**tomllib.loads(PART)["submission"], "system": "my-model"}
    assert written["protocol"]["selection"] == "readout"
    assert written["model"] == {"family": "video", "inputs": "rgb"}


def test_options_count_before_the_file(submit: Callable[..., Result], root: Path) -> None:
    """An option stands in place of the file's key, and no other key changes."""
    submit(PART, *REST, "--name=Another", "--training=unified", "--date=2026-11-19")
    written = read_written(root, "another")
    assert (written["submission"]["name"], written["protocol"]["training"]) == ("Another", "unified")
    assert str(written["submission"]["date"]) == "2026-11-19"
    assert written["protocol"]["selection"] == "readout"


def test_a_whole_submission_will_do(submit: Callable[..., Result], example: Path, root: Path) -> None:
    """The submission.toml of an earlier submission serves for the next, in every key."""
    toml = (example / "submission.toml").read_bytes()
    submit(b"\xef\xbb\xbf" + toml.replace(b"\n", b"\r\n"), "--slug=again")
    assert read_written(root, "again") == tomllib.loads(toml.decode())


def test_what_is_missing_in_both_is_named(submit: Callable[..., Result]) -> None:
    """Required keys that neither the file nor an option gives are asked for by the option's name."""
    assert "missing --testing, --family, --inputs" in submit(PART, exit_code=2).output


@pytest.mark.parametrize(
    ("toml", "message"),
    [
        (PART.replace("selection", "selektion"), "metadata: unknown-key: protocol.selektion"),
        (PART.replace('"readout"', '"some"'), "unknown-value: protocol.selection"),
        (PART.replace('"My Model"', "2026"), "wrong-type: submission.name"),
        (PART.replace("2026-11-20", "20"), "wrong-type: submission.date"),
        (PART + "\n[extra]\nkey = 1\n", "unknown-key: extra"),
        ('name = "My Model"\n' + PART, "metadata.toml: name stands outside of a section"),
        (PART + "\nname = \n", "metadata.toml: is not TOML: "),
        (b"\xff", "metadata.toml: is not UTF-8 text"),
        ("#" * 64_001, "metadata.toml is larger than 64,000 bytes"),
        ("a = " + "[" * 3_000, "metadata.toml: is not TOML: "),
    ],
)
def test_faulty_metadata_are_refused(
    submit: Callable[..., Result], root: Path, toml: str | bytes, message: str
) -> None:
    """Keys are judged as those of submission.toml; a file that is none is named. Nothing is written."""
    refused = submit(toml, *REST, exit_code=1)
    assert message in refused.output
    assert [folder.name for folder in (root / "submissions").iterdir()] == ["example-slots"]


def test_a_missing_file_is_wrong_usage(run: Run, example: Path, tmp_path: Path) -> None:
    """The file is named."""
    arguments = ("submit", example / "predictions.csv", "--metadata", tmp_path / "none.toml", *REST)
    assert "none.toml' does not exist" in run(*arguments, exit_code=2).output
