"""The double is held against GitHub's own description, and notices what GitHub would not take or say."""

import json

import pytest

from github_contract import Call, fill, find_violation, load_description
from tools.cut_github_api import OPERATIONS, cut_description

SHA = "0" * 40


def test_the_description_says_what_it_is() -> None:
    """Origin, version and licence are in the file, and the operations are those that are used."""
    description = load_description()
    assert description["info"]["description"].startswith("cut from @octokit/openapi 23.0.2 (MIT) by tools/")
    assert {
        path: sorted(set(methods) - {"parameters"}) for path, methods in description["paths"].items()
    } == {path: sorted(methods) for path, methods in OPERATIONS.items()}


def test_cutting_again_changes_nothing() -> None:
    """The cut of the cut is the cut: nothing that is referred to is missing."""
    description = load_description()
    assert cut_description(description, description["info"]["description"]) == description


@pytest.mark.parametrize(
    ("method", "path", "content"),
    [
        ("POST", "/repos/a/b/git/blobs", {"encoding": "base64"}),
        ("POST", "/repos/a/b/git/refs", {"ref": "refs/heads/x"}),
        ("POST", "/repos/a/b/git/trees", {"tree": [{"mode": "777"}]}),
        ("POST", "/repos/a/b/git/commits", {"message": "x", "tree": 1}),
        ("PATCH", "/repos/a/b/git/refs/heads/x", {"sha": SHA, "force": "yes"}),
        ("POST", "/repos/a/b/pulls", {"title": "x", "head": "a:b"}),
        ("DELETE", "/repos/a/b", {}),
        ("GET", "/repos/a/b/labels", {}),
    ],
)
def test_wrong_requests_are_noticed(method: str, path: str, content: object) -> None:
    """A key that is missing, a value of another type, an operation that is not used."""
    assert find_violation(Call(method, path, {}, json.dumps(content).encode())) != ""


@pytest.mark.parametrize(
    ("path", "status", "content"),
    [
        ("/repos/a/b/git/ref/heads/x", 200, {"ref": "refs/heads/x"}),
        ("/repos/a/b/git/ref/heads/x", 418, {"message": "x"}),
        ("/repos/a/b/git/ref/heads/x", 404, {"message": 1}),
        (f"/repos/a/b/git/commits/{SHA}", 200, fill("git-commit", {"sha": 1})),
        ("/repos/a/b/contents/reference", 200, [{"name": "x"}]),
    ],
)
def test_wrong_answers_are_noticed(path: str, status: int, content: object) -> None:
    """What the double says, GitHub could say."""
    call = Call("GET", path, {}, b"")
    assert find_violation(call) == ""
    assert find_violation(call, (status, content)) != ""


def test_keys_that_github_does_not_know_are_noticed() -> None:
    """A mistyped key in the double is not filled over."""
    with pytest.raises(KeyError, match="defualt_branch"):
        fill("full-repository", {"defualt_branch": "main"})
