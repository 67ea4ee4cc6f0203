"""What is read of GitHub's answers; the rest of them is not looked at."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

ObjectId = Annotated[str, Field(pattern=r"^[0-9a-f]{40}$")]
Login = Annotated[str, Field(pattern=r"^[A-Za-z0-9_\[\]-]{1,100}$")]
FullName = Annotated[str, Field(pattern=r"^[A-Za-z0-9_-]{1,100}/[A-Za-z0-9._-]{1,100}$")]


class Answer(BaseModel):
    """A part of an answer; keys that are not named are skipped."""

    model_config = ConfigDict(extra="ignore", frozen=True)


class User(Answer):
    """Somebody with an account."""

    login: Login
    id: int


class Parent(Answer):
    """What a repository is a fork of."""

    full_name: FullName


class Repository(Answer):
    """A repository: ``parent`` is what it was forked from."""

    full_name: FullName
    owner: User
    default_branch: Annotated[str, Field(pattern=r"^[^\s\x00-\x1f\x7f~^:?*\[\\]{1,255}$")]
    fork: bool
    archived: bool = False
    allow_forking: bool = True
    parent: Parent | None = None


class GitObject(Answer):
    """A blob, tree or commit by its id."""

    sha: ObjectId


class Reference(Answer):
    """A branch, and the commit that it names."""

    object: GitObject


class Commit(Answer):
    """A commit with its tree and parents."""

    sha: ObjectId
    tree: GitObject
    parents: tuple[GitObject, ...]


class Entry(Answer):
    """A file or folder within a folder."""

    name: str
    sha: ObjectId


class ChangedFile(Answer):
    """A path that differs between two commits; a renamed file has its former path, too."""

    filename: str
    previous_filename: str | None = None


class Comparison(Answer):
    """What one commit has changed since it and another went apart."""

    files: tuple[ChangedFile, ...] = ()


class Head(Answer):
    """What a pull request asks to take: ``label`` is ``OWNER:BRANCH``."""

    label: str


class PullRequest(Answer):
    """A pull request: ``merged_at`` is empty unless it was taken."""

    number: int
    head: Head
    html_url: Annotated[str, Field(pattern=r"^https?://[!-~]{1,500}$")]
    state: str
    body: str | None = None
    merged_at: str | None = None
