"""The leaderboard's repository, and the sender's own copy of it that takes the branch."""

from dataclasses import dataclass
from urllib.parse import quote

from leaderboard.changes.git_objects import blob_id
from leaderboard.github.addresses import NAME_HINT
from leaderboard.github.answers import Commit, Entry, Reference, Repository, User
from leaderboard.github.client import Client
from leaderboard.github.failures import RERUN_HINT
from leaderboard.github.proposals import Proposal


@dataclass(frozen=True)
class Upstream:
    """The repository that takes submissions, and the commit on which a new one is put."""

    repository: Repository
    head: str

    @property
    def path(self) -> str:
        """Its place in the API."""
        return repository_path(self.repository.full_name)

    @property
    def branch(self) -> str:
        """The branch that takes submissions."""
        return self.repository.default_branch


def find_upstream(client: Client, name: str, user: User, *, is_named: bool) -> Upstream:
    """Look at the repository that takes submissions.

    Parameters
    ----------
    client
        Asks.
    name
        The repository, ``OWNER/NAME``.
    user
        Who sends.
    is_named
        Whether the user named it. Otherwise, if it is the user's own fork, what it was forked from is meant.

    Raises
    ------
    GitHubError
        If it is not there, or takes nothing.
    """
    repository = client.find(repository_path(name), Repository)
    if repository is not None and repository.parent and not is_named and _is_own(repository, user):
        repository = client.find(repository_path(repository.parent.full_name), Repository)
    if repository is None:
        hint = f"or the token may not see it; if it is another, {NAME_HINT}"
        raise client.fail(f"there is no repository {name}", hint)
    if repository.archived:
        raise client.fail(f"{repository.full_name} is archived and takes nothing any more", NAME_HINT)
    path = f"{repository_path(repository.full_name)}/git/ref/heads/{quote(repository.default_branch)}"
    return Upstream(repository, client.get(path, Reference).object.sha)


def check_reference(client: Client, upstream: Upstream, proposal: Proposal) -> None:
    """Make sure that the repository grades with the reference that is here.

    Raises
    ------
    GitHubError
        If it has none, or another one: it would find another result.
    """
    path, content = proposal.manifest
    folder, _, name = path.rpartition("/")
    found = list_folder(client, upstream, folder).get(name)
    full_name = upstream.repository.full_name
    if found is None:
        raise client.fail(f"{full_name} is no leaderboard: it has no {path}", NAME_HINT)
    if found != blob_id(content):
        hint = f"bring this folder up to date (git pull), then leaderboard grade {proposal.folder}"
        raise client.fail(f"the reference of {full_name} is not the one here, so scores would differ", hint)


def list_folder(client: Client, upstream: Upstream, folder: str) -> dict[str, str]:
    """Map the names in a folder that is published to the ids of their contents; empty if there is none."""
    path = f"{upstream.path}/contents/{quote(folder)}"
    return {entry.name: entry.sha for entry in client.find(path, list[Entry], ref=upstream.head) or []}


def open_target(client: Client, upstream: Upstream, user: User) -> tuple[str, Commit]:
    """Find or make the repository that takes the branch: the user's fork, or their own repository itself.

    Returns
    -------
    name : str
        The repository.
    base : Commit
        The upstream's newest commit, which it holds.

    Raises
    ------
    GitHubError
        If there can be no fork, or it is not ready in time.
    """
    if _is_own(upstream.repository, user):
        name = upstream.repository.full_name
        return name, client.get(f"{upstream.path}/git/commits/{upstream.head}", Commit)
    fork = _find_fork(client, upstream, user) or _make_fork(client, upstream)
    client.begin(f"looking at your fork {fork.full_name}")
    return fork.full_name, _wait_for_base(client, fork, upstream)


def repository_path(full_name: str) -> str:
    """Say where a repository is in the API."""
    return f"/repos/{full_name}"


def _is_own(repository: Repository, user: User) -> bool:
    return repository.owner.login.lower() == user.login.lower()


def _find_fork(client: Client, upstream: Upstream, user: User) -> Repository | None:
    """Find the user's fork under the name that forks have; GitHub itself finds those of other names."""
    name = upstream.repository.full_name.rpartition("/")[2]
    found = client.find(repository_path(f"{user.login}/{name}"), Repository)
    parent = found.parent if found is not None and found.fork else None
    return found if parent and parent.full_name.lower() == upstream.repository.full_name.lower() else None


def _make_fork(client: Client, upstream: Upstream) -> Repository:
    client.begin(f"making a fork of {upstream.repository.full_name}")
    if not upstream.repository.allow_forking:
        raise client.fail(
            "its owners do not allow forks", "ask them to, or to take the folder in another way"
        )
    return client.post(f"{upstream.path}/forks", {"default_branch_only": True}, Repository)


def _wait_for_base(client: Client, fork: Repository, upstream: Upstream) -> Commit:
    """Wait until the fork holds the upstream's newest commit.

    GitHub goes on copying after it has answered. Once there is a branch but not that commit, the fork is an
    older one, and is brought up to date as its button on GitHub does.
    """
    path = repository_path(fork.full_name)
    is_current = False
    for n in range(1, client.patience.fork_checks + 1):
        base = client.find(f"{path}/git/commits/{upstream.head}", Commit)
        if base is not None:
            return base
        branch = f"{path}/git/ref/heads/{quote(upstream.branch)}"
        if not is_current and client.find(branch, Reference) is not None:
            client.begin(f"bringing your fork {fork.full_name} up to date")
            client.post(f"{path}/merge-upstream", {"branch": upstream.branch}, dict[str, object])
            is_current = True
        else:
            client.patience.sleep(float(n))
    raise client.fail("GitHub has not finished copying", f"in some minutes, {RERUN_HINT}")
