"""What GitHub keeps: bare repositories on disk, who forked what, and pull requests."""

import os
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from git_trees import GitTrees, Tree

DATE = "2026-06-01T00:00:00Z"  # so that the same commit has the same id


class MissingObjectError(Exception):
    """Git has no such object or branch."""


@dataclass
class Repo:
    """A repository: ``checks_until_ready`` is how often its objects are asked for before they are there."""

    full_name: str
    folder: Path
    parent: str | None = None
    archived: bool = False
    allow_forking: bool = True
    default_branch: str = "main"
    checks_until_ready: int = 0

    def git(
        self, *arguments: str, content: bytes = b"", environment: Mapping[str, str] | None = None
    ) -> bytes:
        """Run git in it."""
        done = subprocess.run(
            ["git", *arguments],  # noqa: S607
            cwd=self.folder,
            input=content,
            env={
                **os.environ,
                "GIT_CONFIG_NOSYSTEM": "1",
                "GIT_CONFIG_GLOBAL": os.devnull,
                **(environment or {}),
            },
            capture_output=True,
            check=False,
        )
        if done.returncode:
            raise MissingObjectError(done.stderr.decode())
        return done.stdout

    def find(self, name: str) -> str | None:
        """Return the id of an object, or None."""
        try:
            return self.git("rev-parse", "--verify", "--quiet", "--end-of-options", name).decode().strip()
        except MissingObjectError:
            return None

    def branch(self, name: str) -> str | None:
        """Return the commit at a branch's head, or None."""
        return self.find(f"refs/heads/{name}^{{commit}}")

    def set_branch(self, name: str, commit: str) -> None:
        self.git("update-ref", f"refs/heads/{name}", commit)

    def read_commit(self, commit: str) -> tuple[str, list[str]]:
        """Return a commit's tree and parents."""
        tree, *parents = self.git("show", "-s", "--format=%T %P", f"{commit}^{{commit}}").decode().split()
        return tree, parents

    def show(self, commit: str) -> list[str]:
        """Author, address and subject of a commit."""
        return self.git("show", "-s", "--format=%an%n%ae%n%s", commit).decode().splitlines()

    def list_folder(self, commit: str, path: str) -> list[tuple[str, str, int, str]]:
        """List kind, id, size and path of a folder's entries."""
        listing = self.git("ls-tree", "-l", commit, "--", f"{path}/").decode()
        rows = [line.partition("\t") for line in listing.splitlines()]
        return [
            (meta.split()[1], meta.split()[2], int(meta.split()[3].replace("-", "0")), name)
            for meta, _, name in rows
        ]

    def write_tree(self, base: str, entries: Sequence[Mapping[str, str]]) -> str:
        """Make a tree from another one and entries to add to it."""
        index = {"GIT_INDEX_FILE": str(self.folder / "index")}
        self.git("read-tree", base, environment=index)
        lines = "".join(f"{e['mode']} {e['sha']}\t{e['path']}\n" for e in entries)
        self.git("update-index", "--index-info", content=lines.encode(), environment=index)
        return self.git("write-tree", environment=index).decode().strip()

    def write_commit(self, tree: str, parents: list[str], message: str, author: Mapping[str, str]) -> str:
        """Make a commit of that author, at the one moment that there is."""
        options = [option for parent in parents for option in ("-p", parent)]
        people = {
            f"GIT_{role}_{key}": value
            for role in ("AUTHOR", "COMMITTER")
            for key, value in (("NAME", author["name"]), ("EMAIL", author["email"]), ("DATE", DATE))
        }
        return self.git("commit-tree", tree, *options, "-m", message, environment=people).decode().strip()


@dataclass
class Pull:
    """A pull request."""

    number: int
    repo: str
    head: str
    base: str
    title: str
    body: str
    state: str = "open"
    merged_at: str | None = None


@dataclass
class Hub:
    """All repositories below a folder, and all pull requests.

    Attributes
    ----------
    shares_objects
        Whether a fork sees what is new in its parent without being brought up to date.
    fork_delay
        How often the objects of a new fork are asked for before they are there.
    """

    folder: Path
    repos: dict[str, Repo] = field(default_factory=dict)
    pulls: list[Pull] = field(default_factory=list)
    shares_objects: bool = True
    fork_delay: int = 0

    def add(self, full_name: str, files: Tree) -> Repo:
        """Make a repository with one commit."""
        repo = Repo(full_name, self.folder / f"{full_name}.git")
        repo.folder.mkdir(parents=True)
        repo.git("init", "-q", "--bare", "-b", repo.default_branch)
        repo.set_branch("main", GitTrees(repo.folder).commit(files))
        self.repos[full_name] = repo
        return repo

    def find(self, full_name: str) -> Repo | None:
        """Find a repository, whatever its capitals."""
        return next((r for name, r in self.repos.items() if name.lower() == full_name.lower()), None)

    def find_fork(self, parent: str, login: str) -> Repo | None:
        """Find somebody's fork, or the repository itself if it is theirs."""
        network = [r for r in self.repos.values() if parent in {r.parent, r.full_name}]
        return next((r for r in network if r.full_name.partition("/")[0].lower() == login.lower()), None)

    def fork(self, parent: Repo, login: str) -> Repo:
        """Make somebody's fork; where its name is taken it gets another one."""
        name = f"{login}/{parent.full_name.partition('/')[2]}"
        name = f"{name}-1" if name in self.repos else name
        repo = Repo(name, self.folder / f"{name}.git", parent.full_name)
        repo.folder.parent.mkdir(parents=True, exist_ok=True)
        sharing = ["--shared"] if self.shares_objects else ["--no-hardlinks"]
        parent.git("clone", "-q", "--bare", "--single-branch", *sharing, ".", str(repo.folder))
        repo.checks_until_ready = self.fork_delay
        self.repos[name] = repo
        return repo

    def advance(self, repo: Repo, files: Tree, branch: str = "main") -> str:
        """Add a commit to a branch, as somebody else does meanwhile; the files are added to those there."""
        head = repo.branch(branch) or repo.branch(repo.default_branch)
        assert head is not None
        extra = GitTrees(repo.folder)
        tree = repo.read_commit(head)[0]
        entries = []
        for path, content in files.items():
            assert isinstance(content, bytes)
            blob = extra.run("hash-object", "-w", "--stdin", content=content).decode().strip()
            entries.append({"mode": "100644", "sha": blob, "path": path})
        author = {"name": "Somebody", "email": "somebody@github.example"}
        commit = repo.write_commit(repo.write_tree(tree, entries), [head], "Something else", author)
        repo.set_branch(branch, commit)
        return commit

    def merge(self, pull: Pull) -> None:
        """Take a pull request whose branch is ahead of the base."""
        login, _, branch = pull.head.partition(":")
        upstream, fork = self.repos[pull.repo], self.find_fork(pull.repo, login)
        assert fork is not None
        upstream.git("fetch", "-q", str(fork.folder), f"{branch}:{pull.base}")
        pull.state, pull.merged_at = "closed", DATE

    def describe(self) -> dict[str, object]:
        """All that may be seen from outside: branches and pull requests."""
        branches = {
            name: repo.git("for-each-ref", "--format=%(refname) %(objectname)").decode().splitlines()
            for name, repo in sorted(self.repos.items())
        }
        return {
            **branches,
            "pulls": [(p.number, p.head, p.base, p.title, p.body, p.state) for p in self.pulls],
        }
