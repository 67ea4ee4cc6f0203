"""A token is found where it should be, and is never shown."""

from pathlib import Path

import pytest

from leaderboard.github.tokens import Token, TokenError, find_token

SECRET = "ghp_0123456789abcdef"  # noqa: S105


@pytest.fixture
def gh(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A stand-in of GitHub's command line that knows one host."""
    program = tmp_path / "gh"
    program.write_text(
        '#!/bin/sh\n[ "$*" = "auth token --hostname git.example.com" ] || exit 1\n' + f"echo {SECRET}\n"
    )
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    return program


@pytest.mark.parametrize(
    ("variables", "origin"),
    [
        ({"GITHUB_TOKEN": SECRET, "GH_TOKEN": "other-token"}, "GITHUB_TOKEN"),
        ({"GH_TOKEN": f"{SECRET}\n"}, "GH_TOKEN"),
        ({"GITHUB_TOKEN": " ", "GH_TOKEN": SECRET}, "GH_TOKEN"),
    ],
)
def test_variables_come_first(variables: dict[str, str], origin: str) -> None:
    """In this order, and without line ends that a file had."""
    assert find_token(variables, "github.com") == Token(SECRET, origin)


@pytest.mark.usefixtures("gh")
def test_gh_is_asked_for_the_host() -> None:
    """Its token for that very host, and none for another."""
    assert find_token({}, "git.example.com") == Token(SECRET, "gh")
    with pytest.raises(
        TokenError, match=r"^no token for github.com: neither GITHUB_TOKEN nor GH_TOKEN is set"
    ) as failure:
        find_token({}, "github.com")
    assert (
        failure.value.hint
        == "run gh auth login, or put a classic token with the scope public_repo into GITHUB_TOKEN"
    )


def test_without_gh_it_is_told(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A machine without GitHub's command line."""
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(TokenError, match="no token for github"):
        find_token({}, "github.com")


def test_a_gh_that_cannot_run_is_none(gh: Path) -> None:
    """A broken program is no reason for a traceback."""
    gh.write_text("#!/no/such/interpreter\n")
    with pytest.raises(TokenError, match="no token for git"):
        find_token({}, "git.example.com")


@pytest.mark.parametrize("value", ["abc", "two words here", "quo\ntes0123456", "gh_ключ0123456", "x" * 3000])
def test_what_cannot_be_a_token_is_not_sent(value: str) -> None:
    """It would break a header, or is a mistake; it is not shown either."""
    with pytest.raises(TokenError, match="what GITHUB_TOKEN holds is no token") as failure:
        find_token({"GITHUB_TOKEN": value}, "github.com")
    assert value not in str(failure.value)


def test_a_token_does_not_show_itself() -> None:
    """Neither printed nor in a text that it is taken out of."""
    token = Token(SECRET, "gh")
    assert SECRET not in repr(token) + str(token)
    assert token.redact(f"a {SECRET} b") == "a *** b"
