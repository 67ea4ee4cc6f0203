"""A submission becomes one commit on a branch and one pull request, however often and whatever happens."""

import json
import re
from pathlib import Path
from typing import Literal

import pytest

from github_double import Fault
from github_hub import Pull
from github_stage import BRANCH, FORK, SECRET, UPSTREAM, Stage
from leaderboard.github.failures import GitHubError
from leaderboard.github.proposals import draft_proposal
from leaderboard.report.proposal import Outcome
from raw_submissions import SUBMISSION_TOML

FIRST = Outcome("opened", 1, "https://github.example/lab/board/pull/1")
FILES = ["predictions.csv", "result.json", "submission.toml"]

CALLS = [
    r"GET /user",
    r"GET /repos/lab/board",
    r"GET /repos/lab/board/git/ref/heads/main",
    r"GET /repos/lab/board/contents/reference",
    r"GET /repos/lab/board/contents/submissions/example",
    r"GET /repos/someone/board",
    r"POST /repos/lab/board/forks",
    r"GET /repos/someone/board/git/commits/[0-9a-f]{40}",
    r"GET /repos/someone/board/git/ref/heads/submission-example",
    r"POST /repos/someone/board/git/blobs",
    r"POST /repos/someone/board/git/blobs",
    r"POST /repos/someone/board/git/blobs",
    r"POST /repos/someone/board/git/trees",
    r"POST /repos/someone/board/git/commits",
    r"POST /repos/someone/board/git/refs",
    r"GET /repos/lab/board/pulls",
    r"POST /repos/lab/board/pulls",
]
# The same up to the fork, which is there; then the branch is looked at, and both it and the text are changed.
CALLS_AGAIN = [
    *CALLS[:6],
    *CALLS[7:9],
    r"GET /repos/someone/board/git/commits/[0-9a-f]{40}",
    r"GET /repos/someone/board/compare/[0-9a-f]{40}\.\.\.[0-9a-f]{40}",
    *CALLS[9:14],
    r"PATCH /repos/someone/board/git/refs/heads/submission-example",
    r"GET /repos/lab/board/pulls",
    r"PATCH /repos/lab/board/pulls/1",
]
WRITING = [n for n, call in enumerate(CALLS, 1) if not call.startswith("GET")]
WRITING_AGAIN = [n for n, call in enumerate(CALLS_AGAIN, 1) if not call.startswith("GET")]

Kind = Literal["drop", "lose"]


def changed_files(stage: Stage, branch: str = BRANCH) -> list[str]:
    head = stage.fork.branch(branch)
    assert head is not None
    names = stage.fork.git("diff-tree", "-r", "--name-only", f"{head}^", head).decode()
    return names.split()


def base_of_branch(stage: Stage) -> list[str]:
    head = stage.fork.branch(BRANCH)
    assert head is not None
    return stage.fork.read_commit(head)[1]


def test_a_submission_is_sent(stage: Stage, tmp_path: Path) -> None:
    """One commit with its three files, by its sender, on top of what is published; judged, it is fine."""
    assert stage.send() == FIRST
    assert len(stage.lines()) == len(CALLS)
    assert [
        line for line, call in zip(stage.lines(), CALLS, strict=True) if not re.fullmatch(call, line)
    ] == []
    assert base_of_branch(stage) == [stage.upstream.branch("main")]
    assert stage.fork.show(BRANCH) == ["someone", "4711+someone@users.noreply.127.0.0.1", "Submit example"]
    assert changed_files(stage) == [f"submissions/example/{name}" for name in FILES]
    check = stage.judge(tmp_path / "judge")
    assert (check.slug, check.problems, check.is_fine) == ("example", (), True)
    (pull,) = stage.hub.pulls
    assert (pull.head, pull.base, pull.title) == (f"someone:{BRANCH}", "main", "Submit example")
    assert pull.body == stage.material.draft().body


def test_each_step_is_told(stage: Stage) -> None:
    """Who waits knows what for."""
    stage.send()
    assert stage.told == [
        "asking GitHub whose token it is",
        "looking at lab/board",
        "making a fork of lab/board",
        "looking at your fork someone/board",
        "looking at the branch submission-example of someone/board",
        "sending 3 files to someone/board",
        "looking for a pull request in lab/board",
        "opening a pull request in lab/board",
    ]


def test_sending_again_changes_nothing(stage: Stage) -> None:
    """The same submission gives the same state, without a second commit or pull request."""
    stage.send()
    state = stage.hub.describe()
    assert stage.send() == Outcome("unchanged", FIRST.number, FIRST.url)
    assert stage.hub.describe() == state


def test_a_mended_submission_takes_the_place_of_the_former(stage: Stage, tmp_path: Path) -> None:
    """Branch and pull request stay, with one commit of other predictions and another text."""
    stage.send()
    mended = stage.material.draft(is_reversed=True)
    assert stage.send(mended) == Outcome("updated", FIRST.number, FIRST.url)
    assert len(stage.hub.pulls) == 1
    assert stage.hub.pulls[0].body == mended.body
    assert changed_files(stage) == [f"submissions/example/{name}" for name in FILES]
    assert base_of_branch(stage) == [stage.upstream.branch("main")]
    assert stage.judge(tmp_path / "judge").problems == ()


@pytest.mark.parametrize(
    ("kind", "on"), [*(("drop", n) for n in range(1, len(CALLS) + 1)), *(("lose", n) for n in WRITING)]
)
def test_whoever_is_interrupted_starts_over(stage: Stage, kind: Kind, on: int) -> None:
    """Cut off at any call, before or after it was done: sent again, the state is as if nothing had been."""
    stage.github.faults = [Fault(on, kind, times=1)]
    with pytest.raises(GitHubError, match=r"the connection was cut") as failure:
        stage.send()
    assert failure.value.hint == "run the command again: it goes on where it stopped"
    again = stage.send()
    assert (again.number, again.url) == (1, FIRST.url)
    assert again.done == ("unchanged" if (kind, on) == ("lose", len(CALLS)) else "opened")
    assert changed_files(stage) == [f"submissions/example/{name}" for name in FILES]
    assert base_of_branch(stage) == [stage.upstream.branch("main")]
    assert list(stage.hub.repos) == [UPSTREAM, FORK]
    assert [(pull.state, pull.body) for pull in stage.hub.pulls] == [("open", stage.material.draft().body)]
    assert stage.fork.git("for-each-ref", "--format=%(refname)").decode().split() == [
        "refs/heads/main",
        f"refs/heads/{BRANCH}",
    ]


@pytest.mark.parametrize(
    ("kind", "on"),
    [*(("drop", n) for n in range(1, len(CALLS_AGAIN) + 1)), *(("lose", n) for n in WRITING_AGAIN)],
)
def test_whoever_is_interrupted_while_mending_starts_over(stage: Stage, kind: Kind, on: int) -> None:
    """Cut off at any call of a run that replaces what was sent: sent again, all of it is replaced."""
    stage.send()
    mended = stage.material.draft(is_reversed=True)
    stage.github.faults = [Fault(len(CALLS) + on, kind, times=1)]
    with pytest.raises(GitHubError, match=r"the connection was cut"):
        stage.send(mended)
    assert [
        line
        for line, call in zip(stage.lines()[len(CALLS) :], CALLS_AGAIN, strict=False)
        if not re.fullmatch(call, line)
    ] == []
    assert stage.send(mended).done in {"updated", "unchanged"}
    assert len(stage.hub.pulls) == 1
    assert stage.hub.pulls[0].body == mended.body
    for name, content in mended.files.items():
        assert stage.fork.git("show", f"{BRANCH}:submissions/example/{name}") == content


def test_a_new_fork_is_waited_for(stage: Stage) -> None:
    """GitHub answers before it has copied anything."""
    stage.hub.fork_delay = 4
    assert stage.send() == FIRST
    assert stage.clock.slept == [1.0, 2.0]


def test_a_fork_that_is_not_ready_can_be_gone_on_from(stage: Stage) -> None:
    """Not forever; the next run finds it."""
    stage.hub.fork_delay = 13
    with pytest.raises(
        GitHubError, match=r"^looking at your fork someone/board: GitHub has not finished"
    ) as failure:
        stage.send()
    assert failure.value.hint == "in some minutes, run the command again: it goes on where it stopped"
    assert stage.send() == FIRST
    assert stage.lines().count("POST /repos/lab/board/forks") == 1


def test_what_was_published_meanwhile_is_built_upon(stage: Stage, tmp_path: Path) -> None:
    """The fork is older than the leaderboard; the commit is on top of its newest one all the same."""
    stage.send()
    newest = stage.hub.advance(stage.upstream, {"submissions/other/result.json": b"{}"})
    assert stage.send() == Outcome("updated", 1, FIRST.url)
    assert base_of_branch(stage) == [newest]
    assert changed_files(stage) == [f"submissions/example/{name}" for name in FILES]
    assert stage.judge(tmp_path / "judge").problems == ()


def test_an_old_fork_is_brought_up_to_date_if_it_must(stage: Stage) -> None:
    """Where the fork does not see the newest commit, its branch is taken forward, and nothing else of it."""
    stage.hub.shares_objects = False
    stage.send()
    newest = stage.hub.advance(stage.upstream, {"docs/new.md": b"x"})
    assert stage.send().done == "updated"
    assert stage.fork.branch("main") == newest
    assert base_of_branch(stage) == [newest]


def test_a_fork_that_went_its_own_way_is_not_touched(stage: Stage) -> None:
    """If it cannot be taken forward, its owner is told how to do it."""
    stage.hub.shares_objects = False
    stage.send()
    own = stage.hub.advance(stage.fork, {"README.md": b"mine"})
    stage.hub.advance(stage.upstream, {"docs/new.md": b"x"})
    with pytest.raises(
        GitHubError, match=r"^bringing your fork someone/board up to date: .* merge conflicts"
    ) as failure:
        stage.send()
    assert failure.value.hint.startswith("press Sync fork on your fork's page on GitHub")
    assert stage.fork.branch("main") == own


def test_a_branch_with_other_work_is_left_alone(stage: Stage) -> None:
    """A branch of that name that changes anything else is somebody's, and is not replaced."""
    stage.hub.fork(stage.upstream, "someone")
    own = stage.hub.advance(stage.fork, {"notes.md": b"mine"}, BRANCH)
    with pytest.raises(GitHubError, match=r"it changes 'notes.md' too, and would be lost") as failure:
        stage.send()
    assert failure.value.hint == "rename or delete that branch, then run the command again"
    assert stage.fork.branch(BRANCH) == own
    assert [line for line in stage.lines() if not line.startswith("GET")] == []


def test_what_somebody_mended_in_the_browser_is_replaced(stage: Stage) -> None:
    """More commits in the submission's own folder give way to what is here."""
    stage.send()
    sent = stage.fork.branch(BRANCH)
    stage.hub.advance(stage.fork, {"submissions/example/submission.toml": b"x"}, BRANCH)
    assert stage.send().done == "updated"
    assert stage.fork.branch(BRANCH) == sent


def test_another_ones_pull_request_is_not_touched(stage: Stage) -> None:
    """Should the host list more than it was asked for: only one from that very branch is one's own."""
    stage.hub.pulls.append(Pull(1, UPSTREAM, f"other:{BRANCH}", "main", "Another's", "Another's text"))
    content = json.dumps(
        [
            {
                "number": 1,
                "html_url": "https://github.example/lab/board/pull/1",
                "state": "open",
                "body": "Another's text",
                "head": {"label": f"other:{BRANCH}"},
            }
        ]
    )
    stage.github.faults = [Fault("GET /repos/lab/board/pulls", status=200, content=content.encode(), times=1)]
    assert stage.send() == Outcome("opened", 2, "https://github.example/lab/board/pull/2")
    assert stage.hub.pulls[0].body == "Another's text"


def test_after_a_closed_pull_request_a_new_one_is_opened(stage: Stage) -> None:
    """It was closed by a decision; the new one is told from it."""
    stage.send()
    stage.hub.pulls[0].state = "closed"
    assert stage.send() == Outcome("opened", 2, "https://github.example/lab/board/pull/2")
    assert "pull request #1 was closed; a new one is opened" in stage.told
    assert stage.send().done == "unchanged"


def test_what_people_wrote_into_the_text_stays(stage: Stage) -> None:
    """Ticks and remarks outlive a second run, whatever line ends the host gives them."""
    stage.send()
    pull = stage.hub.pulls[0]
    pull.body = (pull.body.replace("- [ ]", "- [x]") + "\nThanks!\n").replace("\n", "\r\n")
    assert stage.send().done == "unchanged"
    assert stage.send(stage.material.draft(is_reversed=True)).done == "updated"
    assert stage.hub.pulls[0].body.count("- [x]") == 2
    assert stage.hub.pulls[0].body.endswith("\nThanks!\n")
    assert stage.hub.pulls[0].body.count("## Submission `example`") == 1


def test_what_is_published_is_not_sent(stage: Stage) -> None:
    """After the merge the command says so and makes nothing."""
    stage.send()
    stage.hub.merge(stage.hub.pulls[0])
    state = stage.hub.describe()
    assert stage.send() == Outcome("published")
    assert stage.hub.describe() == state


def test_published_predictions_are_not_sent_anew(stage: Stage) -> None:
    """They never change, so the sender hears it before anything is sent."""
    stage.send()
    stage.hub.merge(stage.hub.pulls[0])
    with pytest.raises(
        GitHubError, match=r"example is published with other predictions, and these never change"
    ):
        stage.send(stage.material.draft(is_reversed=True))
    assert len(stage.hub.pulls) == 1


def test_a_published_description_may_be_amended(stage: Stage, tmp_path: Path) -> None:
    """Its contact sends it again with another text: a new pull request for the same folder."""
    stage.send()
    stage.hub.merge(stage.hub.pulls[0])
    toml = SUBMISSION_TOML.replace("One or two", "Two")
    assert stage.send(stage.material.draft(toml=toml)) == Outcome(
        "opened", 2, "https://github.example/lab/board/pull/2"
    )
    assert changed_files(stage) == ["submissions/example/submission.toml"]
    assert stage.judge(tmp_path / "judge").problems == ()


def test_a_leaderboards_owner_needs_no_fork(stage: Stage) -> None:
    """GitHub allows nobody to fork their own repository: the branch is made there."""
    stage.github.tokens = dict.fromkeys(stage.github.tokens, "lab")
    assert stage.send().done == "opened"
    assert list(stage.hub.repos) == [UPSTREAM]
    assert stage.upstream.branch(BRANCH) is not None
    assert stage.hub.pulls[0].head == f"lab:{BRANCH}"


def test_a_fork_stands_for_what_it_was_forked_from(stage: Stage) -> None:
    """Who cloned their own fork sends to the leaderboard, unless they name the fork."""
    stage.hub.fork(stage.upstream, "someone")
    assert stage.send(repository=FORK) == FIRST
    assert stage.hub.pulls[0].repo == UPSTREAM
    assert stage.send(repository=FORK, is_named=True).url == "https://github.example/someone/board/pull/2"


def test_a_fork_of_another_name_is_found(stage: Stage) -> None:
    """Where the name is taken, GitHub gives the fork another one, and knows it again."""
    stage.hub.add(FORK, {"README.md": b"mine"})
    assert stage.send() == FIRST
    assert stage.hub.repos["someone/board-1"].branch(BRANCH) is not None
    assert stage.fork.branch(BRANCH) is None
    assert stage.send().done == "unchanged"


def test_another_contact_is_mentioned(stage: Stage) -> None:
    """It may be meant, but only the contact may amend it later."""
    stage.send(stage.material.draft(toml=SUBMISSION_TOML.replace('"someone"', '"other"')))
    assert "note: the contact is other, and you send it as someone" in stage.told


def test_another_reference_is_noticed(stage: Stage) -> None:
    """A result graded with an older reference would be refused, so it is not sent."""
    stage.hub.advance(stage.upstream, {"reference/manifest.json": b"{}"})
    with pytest.raises(GitHubError, match=r"the reference of lab/board is not the one here") as failure:
        stage.send()
    assert failure.value.hint == (
        "bring this folder up to date (git pull), then leaderboard grade submissions/example"
    )


def test_a_repository_without_a_leaderboard_is_noticed(stage: Stage) -> None:
    """A mistyped --repository does not open a pull request at a stranger's."""
    stage.hub.add("lab/other", {"README.md": b"x"})
    with pytest.raises(GitHubError, match=r"lab/other is no leaderboard: it has no reference/manifest.json"):
        stage.send(repository="lab/other")


def test_a_repository_that_is_not_there_is_named(stage: Stage) -> None:
    """With what to do about it."""
    with pytest.raises(
        GitHubError, match=r"^looking at lab/nothing: there is no repository lab/nothing$"
    ) as failure:
        stage.send(repository="lab/nothing")
    assert failure.value.hint == (
        "or the token may not see it; if it is another, name it with --repository OWNER/NAME"
    )


def test_an_archived_repository_is_told(stage: Stage) -> None:
    """It takes nothing, so nothing is forked."""
    stage.upstream.archived = True
    with pytest.raises(GitHubError, match=r"lab/board is archived and takes nothing any more"):
        stage.send()


@pytest.mark.parametrize("says_so", [True, False])
def test_where_forks_are_forbidden_it_is_told(stage: Stage, says_so: bool) -> None:
    """Whether the repository says so itself or GitHub refuses."""
    stage.upstream.allow_forking = False
    if not says_so:
        stage.github.faults = [
            Fault("POST /repos/lab/board/forks", status=403, content=b'{"message": "forking is disabled"}')
        ]
        stage.upstream.allow_forking = True
    with pytest.raises(GitHubError, match=r"^making a fork of lab/board: ") as failure:
        stage.send()
    assert failure.value.hint.endswith("or to take the folder in another way")


def test_files_arrive_as_they_were_sent(stage: Stage) -> None:
    """A blob with another id is not put into a tree."""
    content = b'{"sha": "%s", "url": "https://github.example/x"}' % (b"0" * 40)
    stage.github.faults = [Fault("POST /repos/someone/board/git/blobs", status=201, content=content)]
    with pytest.raises(GitHubError, match=r"predictions.csv has not arrived as it was sent"):
        stage.send()


def test_a_race_for_the_pull_request_ends_well(stage: Stage) -> None:
    """Another run opened it between looking and opening: GitHub refuses, and the next run finds it."""
    stage.send()
    stage.github.faults = [Fault("GET /repos/lab/board/pulls", status=200, content=b"[]", times=1)]
    with pytest.raises(GitHubError, match=r"A pull request already exists for someone:submission-example"):
        stage.send()
    assert stage.send().done == "unchanged"
    assert len(stage.hub.pulls) == 1


def test_only_what_is_valid_is_sent(stage: Stage) -> None:
    """A proposal of anything else is a mistake of the program's."""
    bad = stage.material.assess(toml="")
    with pytest.raises(ValueError, match=r"^only a valid submission is sent$"):
        draft_proposal(stage.material.instance, stage.material.reference, bad)


def test_a_token_in_a_file_is_not_published(stage: Stage) -> None:
    """Nothing is sent, not even the question who it is."""
    toml = SUBMISSION_TOML.replace("One or two sentences.", SECRET)
    with pytest.raises(
        GitHubError, match=r"submission.toml holds the token of GITHUB_TOKEN; nothing was sent"
    ):
        stage.send(stage.material.draft(toml=toml))
    assert stage.lines() == []
