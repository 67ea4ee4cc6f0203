"""One open pull request for a branch, with a text of which one part is this program's."""

import re
from typing import Literal

from leaderboard.github.answers import PullRequest
from leaderboard.github.client import Client
from leaderboard.github.proposals import Proposal
from leaderboard.github.repositories import Upstream
from leaderboard.report.proposal import BEGIN_LINE, END_LINE

_OWN_PART = re.compile(
    rf"^{re.escape(BEGIN_LINE)}\r?$.*?^{re.escape(END_LINE)}\r?$", re.MULTILINE | re.DOTALL
)


def open_pull_request(
    client: Client, upstream: Upstream, owner: str, proposal: Proposal
) -> tuple[PullRequest, Literal["opened", "updated", "unchanged"]]:
    """Open a pull request for the branch, or bring the text of the open one up to date.

    Parameters
    ----------
    client
        Asks.
    upstream
        What is to take it.
    owner
        Whose repository has the branch.
    proposal
        What the branch holds.

    Raises
    ------
    GitHubError
        If GitHub refuses.
    """
    client.begin(f"looking for a pull request in {upstream.repository.full_name}")
    head = f"{owner}:{proposal.branch}"
    path = f"{upstream.path}/pulls"
    found = client.get(path, list[PullRequest], head=head, base=upstream.branch, state="all")
    known = [pull for pull in found if pull.head.label.lower() == head.lower()]  # no one else's is touched
    is_open = [pull for pull in known if pull.state == "open"]
    if is_open:
        return _renew(client, upstream, is_open[0], proposal)
    for pull in known:
        if pull.merged_at is None:
            client.tell(f"pull request #{pull.number} was closed; a new one is opened")
    client.begin(f"opening a pull request in {upstream.repository.full_name}")
    content = {"title": proposal.title, "head": head, "base": upstream.branch, "body": proposal.body}
    return client.post(path, content, PullRequest), "opened"


def merge_body(body: str, own: str) -> str:
    """Put this program's part of a text in place of its former one, and leave the rest as it is.

    Parameters
    ----------
    body
        The text of a pull request, which people may have changed.
    own
        The text that a new pull request would have.
    """
    part = _OWN_PART.search(own)
    if part is None:
        return body
    if _OWN_PART.search(body) is None:
        return f"{body.rstrip()}\n\n{part.group()}\n".lstrip("\n")
    return _OWN_PART.sub(lambda _: part.group(), body, count=1)


def _renew(
    client: Client, upstream: Upstream, pull: PullRequest, proposal: Proposal
) -> tuple[PullRequest, Literal["updated", "unchanged"]]:
    old = (pull.body or "").replace("\r\n", "\n")
    body = merge_body(old, proposal.body)
    if body.rstrip() == old.rstrip():
        return pull, "unchanged"
    client.begin(f"bringing pull request #{pull.number} up to date")
    path = f"{upstream.path}/pulls/{pull.number}"
    return client.patch(path, {"body": body}, PullRequest), "updated"
