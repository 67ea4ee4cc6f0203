"""Where a submission goes: the repository that git knows or the user names, by an API that is safe to ask."""

from pathlib import Path

import pytest

from git_trees import GitTrees
from leaderboard.github.addresses import (
    PUBLIC_API,
    check_api_url,
    choose_repository,
    find_prefix,
    is_repository_name,
    parse_remote,
    web_host,
)
from leaderboard.github.failures import GitHubError
from leaderboard.instance import Instance

ENTERPRISE_API = "https://git.example.com/api/v3"


@pytest.fixture
def git(tmp_path: Path) -> GitTrees:
    return GitTrees(tmp_path).init()


@pytest.mark.parametrize(
    "url",
    [
        "https://github.com/lab/board",
        "https://github.com/lab/board.git",
        "https://github.com/lab/board/",
        "https://someone:secret@github.com/lab/board.git",
        "git@github.com:lab/board.git",
        "github.com:lab/board",
        "ssh://git@github.com:22/lab/board.git",
        "git://GitHub.com/lab/board.git",
    ],
)
def test_remotes_are_read(url: str) -> None:
    """In all forms that git takes; names and passwords are left behind."""
    assert parse_remote(url) == ("github.com", "lab/board")


@pytest.mark.parametrize(
    "url",
    [
        "/srv/git/board.git",
        "../board",
        "C:\\board",
        "file:///srv/board.git",
        "https://github.com/lab",
        "https://[x/a/b",
        "",
        "x",
    ],
)
def test_other_remotes_are_not(url: str) -> None:
    """A folder, or an address without owner and name."""
    assert parse_remote(url) is None


@pytest.mark.parametrize(
    "name", ["lab", "lab/board/x", "../..", "lab/..", "lab/bo ard", "lab/board?x", "-/", "läb/board"]
)
def test_what_is_no_name(name: str) -> None:
    """Nothing that would be another place in the API."""
    assert not is_repository_name(name)


def test_the_upstream_comes_before_the_origin(git: GitTrees, tmp_path: Path) -> None:
    """Who has both cloned their own fork."""
    instance = Instance(tmp_path)
    git.run("remote", "add", "origin", "git@github.com:someone/board.git")
    assert choose_repository(instance, None, PUBLIC_API) == "someone/board"
    git.run("remote", "add", "upstream", "https://github.com/lab/board")
    assert choose_repository(instance, None, PUBLIC_API) == "lab/board"
    assert choose_repository(instance, "lab/other", PUBLIC_API) == "lab/other"


@pytest.mark.usefixtures("git")
def test_without_remotes_the_name_is_asked_for(tmp_path: Path) -> None:
    """A repository that was never pushed, and a folder that is none."""
    for folder in (tmp_path, Path("/")):
        with pytest.raises(GitHubError, match=r"which repository takes submissions is not known") as failure:
            choose_repository(Instance(folder), None, PUBLIC_API)
        assert failure.value.hint == "name it with --repository OWNER/NAME"


def test_another_hosts_remote_needs_its_api(git: GitTrees, tmp_path: Path) -> None:
    """The public API is not asked for a name of another host; with that host's, it is."""
    git.run("remote", "add", "origin", "https://someone:secret@git.example.com/lab/board")
    with pytest.raises(GitHubError, match=r"^the git remote origin is at git.example.com, and ") as failure:
        choose_repository(Instance(tmp_path), None, PUBLIC_API)
    assert failure.value.hint == f"name its own: --api-url {ENTERPRISE_API}"
    assert choose_repository(Instance(tmp_path), None, ENTERPRISE_API) == "lab/board"


def test_a_remote_that_is_a_folder_is_told(git: GitTrees, tmp_path: Path) -> None:
    """Its address is not shown: it may hold a password."""
    git.run("remote", "add", "origin", "/srv/secret")
    with pytest.raises(GitHubError, match=r"^the git remote origin is no repository on GitHub$"):
        choose_repository(Instance(tmp_path), None, PUBLIC_API)


def test_a_name_of_another_form_is_told(tmp_path: Path) -> None:
    """With the form that it should have."""
    with pytest.raises(GitHubError, match="--repository 'board' is not of the form OWNER/NAME"):
        choose_repository(Instance(tmp_path), "board", PUBLIC_API)


@pytest.mark.usefixtures("git")
def test_an_instance_may_lie_in_a_folder(tmp_path: Path) -> None:
    """Then that folder goes before every path; without git there is none."""
    (tmp_path / "boards/tiny").mkdir(parents=True)
    assert find_prefix(Instance(tmp_path / "boards/tiny")) == "boards/tiny/"
    assert find_prefix(Instance(tmp_path)) == ""
    assert find_prefix(Instance(Path("/"))) == ""


@pytest.mark.parametrize(
    "url", [PUBLIC_API, ENTERPRISE_API, "http://127.0.0.1:8080/api", "http://localhost:1", "http://[::1]:1"]
)
def test_addresses_that_may_have_the_token(url: str) -> None:
    """Encrypted ones, and this machine."""
    assert check_api_url(f"{url}/") == url


@pytest.mark.parametrize(
    "url",
    [
        "http://api.github.com",
        "api.github.com",
        "ftp://x",
        "https://",
        "https://u:p@x",
        "https://x/?q",
        "https://x/#a",
        "https://x:y",
        "https://x:0",
        "https://x/\n",
        "https://ä",
    ],
)
def test_addresses_that_may_not(url: str) -> None:
    """Where others could read along, and what is more than an address."""
    with pytest.raises(GitHubError, match="--api-url is no https address of an API"):
        check_api_url(url)


def test_hosts_of_apis() -> None:
    """What gh knows a host as, and where its people have their addresses."""
    assert web_host("https://api.tenant.ghe.com") == "tenant.ghe.com"
