"""A branch with one commit that holds one submission's files, on top of what is published."""

import base64
from urllib.parse import quote

from leaderboard.github.answers import Commit, Comparison, GitObject, Reference, User
from leaderboard.github.client import Client
from leaderboard.github.proposals import Proposal
from leaderboard.github.repositories import repository_path

PLAIN_MODE = "100644"


def write_branch(
    client: Client, repository: str, base: Commit, proposal: Proposal, *, author: dict[str, str]
) -> bool:
    """Make the branch, or make it what it should be; tell whether anything was to be done.

    Objects are made anew each time: git keeps one of each content.

    Parameters
    ----------
    client
        Asks.
    repository
        What takes the branch, ``OWNER/NAME``.
    base
        The commit to put it on.
    proposal
        What it holds.
    author
        Name and address for the commit.

    Raises
    ------
    GitHubError
        If a branch of that name holds other changes, or GitHub refuses.
    """
    path = repository_path(repository)
    client.begin(f"looking at the branch {proposal.branch} of {repository}")
    old = _find_branch(client, path, proposal.branch)
    if old is not None:
        _check_ours(client, path, (base.sha, old.sha), proposal)
    client.begin(f"sending {len(proposal.files)} files to {repository}")
    tree = _make_tree(client, path, base, proposal)
    if old is not None and (old.tree.sha, [parent.sha for parent in old.parents]) == (tree, [base.sha]):
        return False
    content = {"message": proposal.title, "tree": tree, "parents": [base.sha], "author": author}
    commit = client.post(f"{path}/git/commits", content, Commit)
    if old is None:
        created = {"ref": f"refs/heads/{proposal.branch}", "sha": commit.sha}
        client.post(f"{path}/git/refs", created, Reference)
    else:
        moved = {"sha": commit.sha, "force": True}
        client.patch(f"{path}/git/refs/heads/{quote(proposal.branch)}", moved, Reference)
    return True


def noreply_author(user: User, host: str) -> dict[str, str]:
    """Name the author of a commit without an address that anybody could write to.

    >>> noreply_author(User(login="octocat", id=1), "github.com")
    {'name': 'octocat', 'email': '1+octocat@users.noreply.github.com'}
    """
    return {"name": user.login, "email": f"{user.id}+{user.login}@users.noreply.{host}"}


def _find_branch(client: Client, path: str, branch: str) -> Commit | None:
    found = client.find(f"{path}/git/ref/heads/{quote(branch)}", Reference)
    return None if found is None else client.get(f"{path}/git/commits/{found.object.sha}", Commit)


def _check_ours(client: Client, path: str, commits: tuple[str, str], proposal: Proposal) -> None:
    """Refuse to replace a branch that changes anything else: it is somebody's work."""
    comparison = client.get(f"{path}/compare/{'...'.join(commits)}", Comparison)
    changed = [name for file in comparison.files for name in (file.filename, file.previous_filename) if name]
    others = [name for name in changed if not name.startswith(f"{proposal.folder}/")]
    if others:
        reason = f"it changes {others[0]!a} too, and would be lost"
        raise client.fail(reason, "rename or delete that branch, then run the command again")


def _make_tree(client: Client, path: str, base: Commit, proposal: Proposal) -> str:
    entries = []
    for name, content in sorted(proposal.files.items()):
        encoded = {"content": base64.b64encode(content).decode(), "encoding": "base64"}
        blob = client.post(f"{path}/git/blobs", encoded, GitObject)
        if blob.sha != proposal.blob_ids[name]:
            raise client.fail(f"{name} has not arrived as it was sent", "run the command again")
        entries.append(
            {"path": f"{proposal.folder}/{name}", "mode": PLAIN_MODE, "type": "blob", "sha": blob.sha}
        )
    tree = {"base_tree": base.tree.sha, "tree": entries}
    return client.post(f"{path}/git/trees", tree, GitObject).sha
