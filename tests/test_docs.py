"""The documents say what is true: their examples run, their lists are complete, their links lead somewhere.

Examples are executed block by block, each document in its own copy of `reference/` and `submissions/`:

- A block ```console holds commands after `$ ` (a backslash at the end of a line continues it) and what they
  print. `...` alone on a line stands for any lines, and at the end of a line for the rest of it. Empty lines
  and blanks at the end of a line do not matter.
- A block with a file's name after its language, such as ```python template.py, becomes that file.
- Other blocks are not executed.

`leaderboard` and `python` in them are those that run the tests. When a message changes on purpose, the
failing test prints what the command says now: put it into the document.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click
import pytest

from leaderboard.cli import group
from leaderboard.cli.submit import command as submit
from leaderboard.grading import METRICS
from leaderboard.models import Metadata
from leaderboard.problems import CODES
from tools.write_problem_docs import render_problem_docs

ROOT = Path(__file__).resolve().parent.parent
DOCUMENTS = sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")])
BLOCK = re.compile(
    r"^```(?P<language>\w+)(?: (?P<file>[\w./-]+))?\n(?P<body>.*?)^```$", re.MULTILINE | re.DOTALL
)
LINK = re.compile(r"(?<!!)\[[^\]]+\]\((?P<target>[^)\s]+)\)")
ROW = re.compile(
    r"^\| `(?P<key>[a-z_.]+)` \| `(?P<option>--[a-z-]+)` \| (?P<required>yes|no) \| (?P<value>.*) \|$",
    re.MULTILINE,
)


@dataclass(frozen=True)
class Example:
    """A command of a document, and the lines that it should print."""

    command: str
    shown: tuple[str, ...]


def name_of(document: Path) -> str:
    return str(document.relative_to(ROOT))


def read_examples(body: str) -> Iterator[Example]:
    joined = body.replace("\\\n", " ")
    for part in re.split(r"^\$ ", joined, flags=re.MULTILINE)[1:]:
        command, *shown = part.rstrip().split("\n")
        yield Example(command, tuple(shown))


def pattern_of(shown: tuple[str, ...]) -> str:
    """Turn the lines of an example into a regular expression for the whole output."""
    lines = [line.rstrip() for line in shown if line.strip()]
    return "".join(
        r"(?:.*\n)*?"
        if line.strip() == "..."
        else re.escape(line.removesuffix("...").rstrip()) + (r".*\n" if line.endswith("...") else r"\n")
        for line in lines
    )


def tidy_output(output: str) -> str:
    return "".join(f"{line.rstrip()}\n" for line in output.splitlines() if line.strip())


def install_commands(folder: Path) -> None:
    """Make `python` and `leaderboard` mean those of the tests, whatever is installed."""
    python = shlex.quote(sys.executable)
    folder.mkdir()
    for name, call in {"python": python, "leaderboard": f"{python} -m leaderboard"}.items():
        (folder / name).write_text(f'#!/bin/sh\nexec {call} "$@"\n', encoding="utf-8")
        (folder / name).chmod(0o755)


@pytest.fixture
def sandbox(tmp_path: Path) -> Path:
    """Copy the instance, and put the commands beside it."""
    install_commands(tmp_path / "bin")
    for part in ("reference", "submissions"):
        shutil.copytree(ROOT / part, tmp_path / "instance" / part)
    return tmp_path / "instance"


def run_command(command: str, folder: Path) -> str:
    path = f"{folder.parent / 'bin'}{os.pathsep}{os.environ['PATH']}"
    environment = os.environ | {"PATH": path, "PYTHONPATH": str(ROOT), "PYTHONUTF8": "1"}
    done = subprocess.run(
        ["/bin/sh", "-c", command],
        cwd=folder,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        encoding="utf-8",
        check=False,
    )
    return tidy_output(done.stdout)


WITH_EXAMPLES = [document for document in DOCUMENTS if "```console" in document.read_text(encoding="utf-8")]


@pytest.mark.parametrize("document", WITH_EXAMPLES, ids=name_of)
def test_examples_print_what_is_shown(document: Path, sandbox: Path) -> None:
    """Every command of a document, run one after the other, prints what the document shows."""
    for block in BLOCK.finditer(document.read_text(encoding="utf-8")):
        if block["file"]:
            (sandbox / block["file"]).write_text(block["body"], encoding="utf-8")
        elif block["language"] == "console":
            for example in read_examples(block["body"]):
                output = run_command(example.command, sandbox)
                assert re.fullmatch(pattern_of(example.shown), output), f"$ {example.command}\n{output}"


@pytest.mark.parametrize(
    "name",
    ["README.md", "docs/submitting.md", "docs/maintaining.md", "docs/converting.md", "docs/readout.md"],
)
def test_guides_have_examples(name: str) -> None:
    """README and the guides show commands with their output, so the test above has something to run."""
    assert ROOT / name in WITH_EXAMPLES


def test_patterns_are_strict() -> None:
    """An output fits only its own lines; dots stand for what is left out and nothing else."""
    pattern = pattern_of(("a.b", "...", "last ..."))
    assert re.fullmatch(pattern, "a.b\nx\ny\nlast one\n")
    assert re.fullmatch(pattern, "a.b\nlast\n")
    assert not re.fullmatch(pattern, "aXb\nlast\n")
    assert not re.fullmatch(pattern, "a.b\nlast\nmore\n")


def walk_commands(command: click.Command, names: tuple[str, ...]) -> Iterator[tuple[str, click.Command]]:
    """Every command and group with its full name."""
    yield " ".join(names), command
    if isinstance(command, click.Group):
        context = click.Context(command)
        for name in command.list_commands(context):
            child = command.get_command(context, name)
            assert child is not None
            yield from walk_commands(child, (*names, name))


COMMANDS = dict(walk_commands(group, ("leaderboard",)))


@pytest.mark.parametrize("name", COMMANDS)
def test_commands_are_documented(name: str) -> None:
    """Each command is named in the list of commands in docs/README.md with every option that it takes."""
    rows = (ROOT / "docs/README.md").read_text(encoding="utf-8").splitlines()
    command = COMMANDS[name]
    options = [max(p.opts, key=len) for p in command.params if isinstance(p, click.Option)]
    if command is submit:
        keys = {row["option"] for row in ROWS.values()}  # in docs/submitting.md; see the test below
        options = [option for option in options if option not in keys]
    if isinstance(command, click.Group) and not options:
        assert any(row.startswith(f"| `{name} ") for row in rows)
        return
    row = next(row for row in rows if re.match(rf"\| `{name}(?: [^a-z][^`]*)?`", row))
    assert [option for option in options if f"`{option}" not in row] == []


def read_keys() -> dict[str, tuple[bool, dict[str, Any]]]:
    """The keys of submission.toml, such as `model.family`: whether each is required, and its JSON schema."""
    schema = Metadata.model_json_schema()
    keys = {}
    for section, pointer in schema["properties"].items():
        model = schema["$defs"][pointer["$ref"].rpartition("/")[2]]
        for key, value in model["properties"].items():
            rule = value.get("anyOf", [value])[0]  # an optional key is one of its kind, or null
            keys[f"{section}.{key}"] = (key in model.get("required", ()), rule)
    return keys


KEYS = read_keys()
GUIDE = (ROOT / "docs/submitting.md").read_text(encoding="utf-8")
ROWS = {row["key"]: row for row in ROW.finditer(GUIDE)}


def test_keys_are_documented() -> None:
    """The guide's table has each key of submission.toml, in order, and says which are required."""
    assert list(ROWS) == list(KEYS)
    required = {key: is_required for key, (is_required, _) in KEYS.items()}
    assert {key: row["required"] == "yes" for key, row in ROWS.items()} == required


@pytest.mark.parametrize("key", KEYS)
def test_values_are_documented(key: str) -> None:
    """The guide's table names the values that a key allows, its limit, and the option that sets it."""
    rule, row = KEYS[key][1], ROWS[key]
    assert re.findall("`([^`]+)`", row["value"]) == rule.get("enum", [])
    assert f"at most {rule.get('maxLength')} characters" in row["value"] or "maxLength" not in rule
    assert row["option"] in {max(p.opts, key=len) for p in submit.params if isinstance(p, click.Option)}


def test_example_metadata_is_valid() -> None:
    """The guide's whole submission.toml is one that the models accept."""
    blocks = [block["body"] for block in BLOCK.finditer(GUIDE) if block["language"] == "toml"]
    assert [Metadata.model_validate(tomllib.loads(block)).submission.name for block in blocks] == [
        "SlotFormer"
    ]


def test_problems_are_documented() -> None:
    """docs/problems.md is what tools/write_problem_docs.py makes of the catalogue, and holds every code."""
    page = (ROOT / "docs/problems.md").read_text(encoding="utf-8")
    assert page == render_problem_docs()
    assert [code for code, entry in CODES.items() if f"`{code}` | {entry.meaning} |" not in page] == []


def test_metrics_are_documented() -> None:
    """docs/method.md has a row with the formula of every metric."""
    page = (ROOT / "docs/method.md").read_text(encoding="utf-8")
    assert [metric.name for metric in METRICS if f"\n| `{metric.name}` |" not in page] == []


@pytest.mark.parametrize("document", DOCUMENTS, ids=name_of)
def test_links_lead_somewhere(document: Path) -> None:
    """Every link to a file of the repository leads to one, and to a heading that it has."""
    for link in LINK.finditer(document.read_text(encoding="utf-8")):
        target, _, anchor = link["target"].partition("#")
        if not re.match(r"[a-z]+:", target):
            page = (document.parent / target).resolve() if target else document
            assert page.exists(), link["target"]
            assert not anchor or anchor in anchors_of(page), link["target"]


def anchors_of(page: Path) -> set[str]:
    """The anchors that GitHub gives a page's headings, and those that the page gives itself."""
    text = page.read_text(encoding="utf-8")
    headings = re.findall(r"^#+ (.+)$", text, re.MULTILINE)
    slugs = {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}
    return slugs | set(re.findall(r'id="([^"]+)"', text))
