"""Commits made by plumbing, so that a tree may hold what no work tree would."""

import os
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

PLAIN, PROGRAM, LINK, SUBMODULE = "100644", "100755", "120000", "160000"
NO_COMMIT = "1" * 40  # what a submodule points to need not be there

Tree = Mapping[str, bytes | tuple[str, bytes]]

_ENVIRONMENT = {
    "GIT_CONFIG_NOSYSTEM": "1",
    "GIT_CONFIG_GLOBAL": os.devnull,
    **{f"GIT_{who}_NAME": "Test" for who in ("AUTHOR", "COMMITTER")},
    **{f"GIT_{who}_EMAIL": "test@example.com" for who in ("AUTHOR", "COMMITTER")},
    **{f"GIT_{who}_DATE": "2026-06-01T00:00:00Z" for who in ("AUTHOR", "COMMITTER")},
}


@dataclass(frozen=True)
class GitTrees:
    """A repository in a folder that may hold other things."""

    folder: Path

    def init(self) -> "GitTrees":
        """Make the repository."""
        self.run("init", "-q", "-b", "main")
        return self

    def run(self, *arguments: str, content: bytes = b"") -> bytes:
        """Run git and return what it prints."""
        return subprocess.run(
            ["git", *arguments],  # noqa: S607
            cwd=self.folder,
            input=content,
            env={**os.environ, **_ENVIRONMENT},
            capture_output=True,
            check=True,
        ).stdout

    def commit(self, files: Tree, *parents: str) -> str:
        """Commit a tree of paths; a tuple gives the mode of a file beside its content."""
        parent_options = [option for parent in parents for option in ("-p", parent)]
        commit = self.run("commit-tree", self._write_tree(files), "-m", "message", *parent_options)
        return commit.decode().strip()

    def _write_tree(self, files: Tree) -> str:
        folders: dict[str, dict[str, bytes | tuple[str, bytes]]] = {}
        lines = []
        for path, content in files.items():
            folder, slash, rest = path.partition("/")
            if slash:
                folders.setdefault(folder, {})[rest] = content
            else:
                lines.append(self._entry(path, content))
        lines += [f"040000 tree {self._write_tree(inner)}\t{name}" for name, inner in folders.items()]
        listing = b"".join(line.encode("utf-8", "surrogateescape") + b"\0" for line in lines)
        return self.run("mktree", "-z", "--missing", content=listing).decode().strip()

    def _entry(self, name: str, content: bytes | tuple[str, bytes]) -> str:
        mode, data = content if isinstance(content, tuple) else (PLAIN, content)
        if mode == SUBMODULE:
            return f"{mode} commit {NO_COMMIT}\t{name}"
        blob = self.run("hash-object", "-w", "--stdin", content=data).decode().strip()
        return f"{mode} blob {blob}\t{name}"
