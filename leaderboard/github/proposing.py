"""From a graded submission to an open pull request, and to the same one when it is done again.

Every step looks at what is there before it makes anything, so whoever is interrupted starts over and ends at
the same state.
"""

from leaderboard.changes.rights import NEW_SLUG_HINT
from leaderboard.github.addresses import web_host
from leaderboard.github.answers import User
from leaderboard.github.branches import noreply_author, write_branch
from leaderboard.github.client import Client
from leaderboard.github.failures import GitHubError
from leaderboard.github.proposals import Proposal
from leaderboard.github.pull_requests import open_pull_request
from leaderboard.github.repositories import (
    Upstream,
    check_reference,
    find_upstream,
    list_folder,
    open_target,
)
from leaderboard.github.tokens import Token
from leaderboard.instance import PREDICTIONS_FILE
from leaderboard.report.proposal import Outcome


def propose(client: Client, proposal: Proposal, repository: str, *, is_named: bool) -> Outcome:
    """Send a submission.

    Parameters
    ----------
    client
        Asks, for whoever sends it.
    proposal
        What to send.
    repository
        What takes it, ``OWNER/NAME``.
    is_named
        Whether the user named the repository, rather than git.

    Raises
    ------
    GitHubError
        If it cannot be sent. Some of it may have been; doing it again goes on from there.
    """
    _keep_secret(client.token, proposal)
    client.begin("asking GitHub whose token it is")
    user = client.get("/user", User)
    client.begin(f"looking at {repository}")
    upstream = find_upstream(client, repository, user, is_named=is_named)
    check_reference(client, upstream, proposal)
    if _is_published(client, upstream, proposal):
        return Outcome("published")
    if proposal.contact.lower() != user.login.lower():
        client.tell(f"note: the contact is {proposal.contact}, and you send it as {user.login}")
    name, base = open_target(client, upstream, user)
    author = noreply_author(user, web_host(client.api_url))
    has_changed = write_branch(client, name, base, proposal, author=author)
    pull, done = open_pull_request(client, upstream, user.login, proposal)
    if has_changed and done == "unchanged":
        done = "updated"
    return Outcome(done, pull.number, client.token.redact(pull.html_url))


def _keep_secret(token: Token, proposal: Proposal) -> None:
    """Refuse to publish the token, should it have got into a file."""
    for name, content in proposal.files.items():
        if token.is_in(content):
            message = f"{proposal.folder}/{name} holds the token of {token.origin}"
            raise GitHubError(f"{message}; nothing was sent", "take it out, and make another token")


def _is_published(client: Client, upstream: Upstream, proposal: Proposal) -> bool:
    """Tell whether the very same is published.

    Raises
    ------
    GitHubError
        If the slug is published with other predictions, which never change.
    """
    published = list_folder(client, upstream, proposal.folder)
    sent = proposal.blob_ids
    if PREDICTIONS_FILE in published and published[PREDICTIONS_FILE] != sent[PREDICTIONS_FILE]:
        reason = f"{proposal.slug} is published with other predictions, and these never change"
        raise client.fail(reason, NEW_SLUG_HINT)
    return published == sent
