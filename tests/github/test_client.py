"""GitHub's refusals are told with what to do, its limits are kept, and the token goes to its host alone."""

import json
import socket
from http import HTTPStatus
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from github_double import Fault, GitHubDouble
from github_hub import Hub
from github_stage import SECRET, UPSTREAM, Stage
from leaderboard.github.client import Client, Patience
from leaderboard.github.failures import GitHubError, explain_refusal
from leaderboard.github.sessions import Reply
from leaderboard.github.tokens import Token

RERUN = "run the command again: it goes on where it stopped"
BLOBS = "POST /repos/someone/board/git/blobs"
SENDING = "sending 3 files to someone/board: "


def words(message: str, **more: object) -> bytes:
    return json.dumps(
        {"message": message, "documentation_url": "https://docs.github.com/rest", **more}
    ).encode()


def test_a_token_that_is_not_accepted(stage: Stage) -> None:
    """401: where the token was found, and how to get another."""
    message, hint = stage.refuse(token="ghp_another0123456789")  # noqa: S106
    assert message == "asking GitHub whose token it is: GitHub does not accept the token of GITHUB_TOKEN"
    assert hint == "it may have expired or been revoked: make another, or run gh auth login"


@pytest.mark.parametrize("status", [403, 404])
def test_a_token_without_the_scope(stage: Stage, status: int) -> None:
    """403, and the 404 with which GitHub hides it: which scope, and how to add it."""
    headers = {"X-OAuth-Scopes": "gist, read:org", "X-Accepted-OAuth-Scopes": "public_repo, repo"}
    stage.github.faults = [Fault("POST /repos/lab/board/forks", status=status, headers=headers)]
    message, hint = stage.refuse()
    assert message == "making a fork of lab/board: the token of GITHUB_TOKEN lacks the scope public_repo"
    assert hint == "gh auth refresh --scopes public_repo, or a classic token with that scope"


def test_a_token_without_the_permission(stage: Stage) -> None:
    """403 for a fine-grained token: what it lacks, and which kind of token does it."""
    headers = {"X-Accepted-GitHub-Permissions": "contents=write"}
    content = words("Resource not accessible by personal access token")
    stage.github.faults = [Fault(BLOBS, status=403, headers=headers, content=content)]
    message, hint = stage.refuse()
    assert message == f"{SENDING}the token of GITHUB_TOKEN lacks the permission contents=write"
    assert hint.startswith("a fine-grained token reaches repositories of one owner only: use gh auth login")


def test_an_organisation_with_single_sign_on(stage: Stage) -> None:
    """403: where to authorise the token."""
    url = "https://github.com/orgs/lab/sso?authorization_request=AB12"
    headers = {"X-GitHub-SSO": f"required; url={url}"}
    stage.github.faults = [Fault("GET /repos/lab/board", status=403, headers=headers)]
    message, hint = stage.refuse()
    assert message == "looking at lab/board: the organisation asks for single sign-on"
    assert hint == f"authorise the token at {url}, then run this again"


def test_a_forbidden_request_is_quoted(stage: Stage) -> None:
    """403 for another reason: GitHub's own words."""
    stage.github.faults = [Fault(BLOBS, status=403, content=words("Repository access blocked"))]
    message, hint = stage.refuse()
    assert message == f"{SENDING}GitHub answers 403 Forbidden (Repository access blocked)"
    assert hint == "mend what GitHub names, then run the command again"


def test_what_is_not_there(stage: Stage) -> None:
    """404 in the middle of it."""
    stage.github.faults = [Fault(BLOBS, status=404, content=words("Not Found"))]
    assert stage.refuse() == (
        f"{SENDING}GitHub answers 404 Not Found (Not Found)",
        "it is not there, or the token may not see it",
    )


def test_a_conflict(stage: Stage) -> None:
    """409: something else changes the repository."""
    stage.github.faults = [Fault(BLOBS, status=409, content=words("Conflict"))]
    assert stage.refuse() == (f"{SENDING}GitHub answers 409 Conflict (Conflict)", RERUN)


@pytest.mark.parametrize(
    ("errors", "quoted"),
    [
        ([{"resource": "PullRequest", "code": "invalid", "field": "head"}], "head: invalid"),
        ([{"code": "custom", "message": "No commits between main and x"}], "No commits between main and x"),
        (["something", 1, None], "something"),
    ],
)
def test_what_is_not_valid(stage: Stage, errors: list[object], quoted: str) -> None:
    """422: every error that GitHub names."""
    content = words("Validation Failed", errors=errors)
    stage.github.faults = [Fault("POST /repos/lab/board/pulls", status=422, content=content)]
    message, hint = stage.refuse()
    assert message == (
        "opening a pull request in lab/board: "
        # Python 3.13 reworded the phrase
        f"GitHub answers 422 {HTTPStatus(422).phrase} (Validation Failed; {quoted})"
    )
    assert hint == "mend what GitHub names, then run the command again"


def test_a_token_that_may_not_move_workflows(stage: Stage) -> None:
    """An old fork cannot be brought forward over a changed workflow; its button on GitHub can."""
    content = words("refusing to allow an OAuth App to create or update workflow `.github/workflows/ci.yml`")
    stage.github.faults = [Fault("POST /repos/someone/board/git/refs", status=422, content=content)]
    assert stage.refuse()[1] == "press Sync fork on your fork's page on GitHub, then run the command again"


@pytest.mark.parametrize("status", [500, 502, 503])
def test_a_broken_server(stage: Stage, status: int) -> None:
    """5xx: reading is tried again, writing is not, since it may have been done."""
    stage.tries = 4
    stage.github.faults = [
        Fault("GET /repos/lab/board/git", status=status, times=3),
        Fault(BLOBS, status=status, content=b"<html>"),
    ]
    message, hint = stage.refuse()
    assert message.startswith(f"{SENDING}GitHub answers {status} ")
    assert hint == RERUN
    assert stage.clock.slept == [1.0, 2.0, 4.0]
    assert stage.lines().count(BLOBS) == 1


def test_a_server_that_stays_broken(stage: Stage) -> None:
    """Reading is given up after some tries."""
    stage.tries = 4
    stage.github.faults = [Fault("GET /user", status=503)]
    assert stage.refuse()[0] == "asking GitHub whose token it is: GitHub answers 503 Service Unavailable"
    assert stage.lines() == ["GET /user"] * 4


def test_a_server_that_says_when_it_is_back(stage: Stage) -> None:
    """The delay that a 503 asks for is kept, and one that is too long is not waited for."""
    stage.tries = 4
    stage.github.faults = [
        Fault("GET /user", status=503, headers={"Retry-After": "7"}, times=1),
        Fault("GET /repos/lab/board", status=503, headers={"Retry-After": "3600"}),
    ]
    assert stage.refuse()[0].startswith("looking at lab/board: GitHub answers 503")
    assert stage.clock.slept == [7.0]


@pytest.mark.parametrize(
    ("fault", "wait"),
    [
        (Fault(BLOBS, status=429, headers={"Retry-After": "30"}, times=1), 30.0),
        (Fault(BLOBS, status=403, headers={"Retry-After": "30"}, times=1), 30.0),
        (Fault(BLOBS, status=429, times=1), 60.0),
        (Fault(BLOBS, status=403, content=words("You have exceeded a secondary rate limit."), times=1), 60.0),
        (
            Fault(
                BLOBS,
                status=403,
                headers={"X-RateLimit-Remaining": "0", "X-RateLimit-Reset": "1800000045"},
                times=1,
            ),
            46.0,
        ),
        (
            Fault(
                BLOBS,
                status=429,
                headers={"X-RateLimit-Remaining": "0", "X-RateLimit-Reset": "soon"},
                times=1,
            ),
            60.0,
        ),
    ],
)
def test_a_short_wait_is_waited(stage: Stage, fault: Fault, wait: float) -> None:
    """What was refused for its number was not done, so writing is tried again as well; who waits is told."""
    stage.tries = 4
    stage.github.faults = [fault]
    assert stage.send().done == "opened"
    assert stage.clock.slept == [wait]
    assert f"GitHub asks to wait for {wait:.0f} seconds" in stage.told


@pytest.mark.parametrize(
    ("headers", "when"),
    [
        (
            {"X-RateLimit-Remaining": "0", "X-RateLimit-Reset": "1800003540"},
            "2027-01-15 08:59 UTC, in 60 minutes",
        ),
        ({"Retry-After": "600"}, "2027-01-15 08:10 UTC, in 10 minutes"),
    ],
)
def test_a_long_wait_is_told(stage: Stage, headers: dict[str, str], when: str) -> None:
    """When to come back, instead of sleeping for an hour; nothing is lost by then."""
    stage.tries = 4
    stage.github.faults = [Fault("POST /repos/someone/board/git/trees", status=403, headers=headers, times=1)]
    assert stage.refuse() == (
        f"{SENDING}GitHub takes no more requests from you for now",
        f"run the command again after {when}: it goes on where it stopped",
    )
    assert stage.clock.slept == []
    assert stage.send().done == "opened"


def test_an_endless_limit_is_given_up(stage: Stage) -> None:
    """Some short waits, then it is told; a moment that no calendar has is not named."""
    stage.tries = 3
    stage.github.faults = [Fault("GET /user", status=429, headers={"Retry-After": "1"})]
    assert "takes no more requests" in stage.refuse()[0]
    assert stage.clock.slept == [1.0, 2.0]
    stage.github.faults = [Fault("GET /user", status=429, headers={"Retry-After": "999999999999"})]
    assert stage.refuse()[1] == "try again tomorrow"


@pytest.mark.parametrize("status", [301, 302, 307, 308])
def test_a_renamed_repository_is_followed(stage: Stage, status: int) -> None:
    """Redirects within the host are followed, as they were asked; the answer has the new name."""
    headers = {"Location": "/api/v3/repos/lab/board"}
    stage.github.faults = [Fault("GET /repos/lab/former", status=status, headers=headers)]
    assert stage.send(repository="lab/former").done == "opened"
    assert stage.lines().count("POST /repos/lab/board/pulls") == 1


@pytest.mark.parametrize("line", ["GET /repos/lab/board", "POST /repos/lab/board/forks"])
def test_another_host_gets_neither_token_nor_content(stage: Stage, hub: Hub, line: str) -> None:
    """A redirect elsewhere ends it, be it another port of the same machine."""
    with GitHubDouble(hub, {SECRET: "thief"}) as thief:
        headers = {"Location": f"{thief.api_url}/repos/{UPSTREAM}"}
        stage.github.faults = [Fault(line, status=307, headers=headers)]
        message, hint = stage.refuse()
        assert f"GitHub sends on to another host, {thief.api_url}/repos/{UPSTREAM}" in message
        assert hint == "nothing was sent there; if that is where the API is, name it with --api-url"
        assert thief.calls == []


@pytest.mark.parametrize(
    "target", ["https://[broken/", "file:///etc/passwd", f"https://x.example/?t={SECRET}"]
)
def test_odd_redirects_are_refused(stage: Stage, target: str) -> None:
    """Whatever the address, it is not followed, and a token in it is not shown."""
    stage.github.faults = [Fault("GET /user", status=302, headers={"Location": target})]
    assert "GitHub sends on to" in stage.refuse()[0]


def test_redirects_without_end_are_given_up(stage: Stage) -> None:
    """After a few."""
    stage.github.faults = [Fault("GET /user", status=302, headers={"Location": "/api/v3/user"})]
    assert "from one address to the next without end" in stage.refuse()[0]
    assert len(stage.lines()) == 6


def test_a_server_that_says_nothing_is_not_waited_for(stage: Stage) -> None:
    """A read that takes too long is a failure like any other."""
    stage.github.faults = [Fault("GET /user", "hang")]
    patience = Patience(read=0.05, tries=2, sleep=stage.clock.sleep)
    with (
        Client(
            stage.github.api_url, Token(SECRET, "gh"), tell=stage.told.append, patience=patience
        ) as client,
        pytest.raises(GitHubError, match="the server does not answer in time"),
    ):
        client.get("/user", dict[str, object])
    assert stage.lines() == ["GET /user"] * 2


def test_a_network_that_is_down(stage: Stage) -> None:
    """Nobody listens there."""
    with socket.socket() as unused:
        unused.bind(("127.0.0.1", 0))
        url = f"http://127.0.0.1:{unused.getsockname()[1]}"
        message, hint = stage.refuse(api_url=url)
    assert message.startswith(f"asking GitHub whose token it is: {url}/user: the server cannot be reached")
    assert hint == f"when it works again, {RERUN}"


def test_a_dropped_connection_is_tried_again_when_reading(stage: Stage) -> None:
    """An interruption costs a second."""
    stage.tries = 4
    stage.github.faults = [Fault("GET /repos/lab/board/pulls", "drop", times=2)]
    assert stage.send().done == "opened"
    assert stage.clock.slept == [1.0, 2.0]


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"<html>Please log in</html>",
        b"null",
        b"[]",
        b'{"login": "x"}',
        b'{"login": "a b", "id": 1}',
        b"[" * 99_999,
        b"\xff",
    ],
)
def test_an_answer_that_is_none_of_githubs(stage: Stage, content: bytes) -> None:
    """A page that asks to log in to the network, or another service: nothing of it is taken for an answer."""
    stage.github.faults = [Fault("GET /user", status=200, content=content)]
    message, hint = stage.refuse()
    assert message == "asking GitHub whose token it is: the answer is not one of GitHub's"
    assert hint.startswith("is --api-url the address of GitHub's API")


HEADERS = ["X-GitHub-SSO", "X-OAuth-Scopes", "X-Accepted-OAuth-Scopes", "X-Accepted-GitHub-Permissions"]


@given(
    status=st.sampled_from([401, 403, 404, 409, 422, 500, 599]),
    content=st.binary(max_size=200)
    | st.text(max_size=400).map(words)
    | st.text(max_size=9).map(lambda text: words(f"Resource not accessible {text}")),
    headers=st.dictionaries(
        st.sampled_from(HEADERS), st.text(max_size=400) | st.just("required; url=https://0\x1b[2J")
    ),
)
def test_any_refusal_is_two_printable_lines_without_the_token(
    status: int, content: bytes, headers: dict[str, str]
) -> None:
    """Whatever a server says, even the token itself, it cannot write to the terminal or to a log."""
    answer = Reply(
        status,
        {name: text.replace("0", SECRET) for name, text in headers.items()},
        content.replace(b"0", SECRET.encode()),
    )
    error = explain_refusal(answer, "sending", Token(SECRET, "gh"))
    for line in (error.message, error.hint):
        assert line.isprintable()
        assert len(line) < 500
        assert SECRET not in line


@pytest.mark.parametrize("content", [b"[]", b'{"message": 1}', b"<html>"])
def test_a_refusal_without_words_is_its_status(stage: Stage, content: bytes) -> None:
    """Something between here and GitHub answers in its place: what to look at is said."""
    stage.github.faults = [Fault("GET /user", status=418, content=content)]
    message, hint = stage.refuse()
    assert message == "asking GitHub whose token it is: GitHub answers 418 I'm a Teapot"
    assert hint.startswith("is --api-url the address of GitHub's API")


def test_a_server_cannot_make_the_token_known(stage: Stage) -> None:
    """A refusal, a header or a redirect that echoes the token is shown without it."""
    for headers, content in [
        ({}, words(f"bad {SECRET}")),
        ({"X-GitHub-SSO": f"required; url=https://x.example/{SECRET}"}, b"{}"),
        ({"X-OAuth-Scopes": "", "X-Accepted-OAuth-Scopes": SECRET}, b"{}"),
        ({"X-Accepted-GitHub-Permissions": SECRET}, words("Resource not accessible")),
    ]:
        stage.github.faults = [Fault("GET /user", status=403, headers=headers, content=content)]
        message, hint = stage.refuse()
        assert "***" in message + hint


def test_passwords_kept_by_the_machine_are_not_used(
    stage: Stage, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """A .netrc for the host does not take the token's place."""
    netrc = tmp_path / "netrc"
    netrc.write_text("machine 127.0.0.1 login somebody password else\n")
    monkeypatch.setenv("NETRC", str(netrc))
    assert stage.send().done == "opened"


def test_no_proxy_reads_what_is_not_encrypted(
    stage: Stage, hub: Hub, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An API on this machine is asked itself: the environment's proxy would see the token."""
    with GitHubDouble(hub, {SECRET: "thief"}) as thief:
        for name in ("http_proxy", "HTTP_PROXY", "ALL_PROXY", "all_proxy"):
            monkeypatch.setenv(name, thief.address)
        assert stage.send().done == "opened"
        assert thief.calls == []


def test_an_answer_without_end_is_cut(stage: Stage, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is larger than any answer of GitHub's is not kept, and so is none."""
    monkeypatch.setattr("leaderboard.github.sessions.CHUNK", 100)
    monkeypatch.setattr("leaderboard.github.sessions.MAX_CHUNKS", 3)
    stage.github.faults = [
        Fault("GET /user", status=200, content=b'{"login": "someone", "id": 1}' + b" " * 271)
    ]
    assert stage.refuse()[0].startswith("looking at lab/board")  # 300 bytes are taken
    stage.github.faults = [
        Fault("GET /user", status=200, content=b" " * 300 + b'{"login": "someone", "id": 1}')
    ]
    assert stage.refuse()[0] == "asking GitHub whose token it is: the answer is not one of GitHub's"
