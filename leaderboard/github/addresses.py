"""Which repository takes submissions, and where its host's API is: as told, or as git knows."""

import re
from urllib.parse import urlsplit

from leaderboard.changes.git_objects import GitError, GitRepository
from leaderboard.github.failures import GitHubError
from leaderboard.instance import Instance

PUBLIC_API = "https://api.github.com"
REMOTES = ("upstream", "origin")  # whoever has both sends to the former
NAME_HINT = "name it with --repository OWNER/NAME"

_NAME = re.compile(r"[A-Za-z0-9_-]{1,100}/[A-Za-z0-9._-]{1,100}")
_SCP = re.compile(r"(?:[^@/]+@)?(?P<host>[^:/@]+):(?P<path>[^:].*)")
_LOOPBACK = frozenset({"127.0.0.1", "localhost", "::1"})


def is_repository_name(text: str) -> bool:
    """Tell whether a text is of the form ``OWNER/NAME``.

    >>> is_repository_name("lab/board"), is_repository_name("lab"), is_repository_name("a/b/c")
    (True, False, False)
    """
    return _NAME.fullmatch(text) is not None and text.rpartition("/")[2] not in {".", ".."}


def check_api_url(api_url: str) -> str:
    """Return the address of an API without a slash at its end.

    Raises
    ------
    GitHubError
        If a token should not go there: it is neither https nor on this machine, or more than an address.
    """
    if not _is_safe(api_url):
        hint = f"write it as {PUBLIC_API} or https://HOST/api/v3"
        raise GitHubError("--api-url is no https address of an API", hint)
    return api_url.rstrip("/")


def web_host(api_url: str) -> str:
    """Name the host to which an API belongs.

    >>> web_host("https://api.github.com"), web_host("https://git.example.com/api/v3")
    ('github.com', 'git.example.com')
    """
    return (urlsplit(api_url).hostname or "").removeprefix("api.")


def parse_remote(url: str) -> tuple[str, str] | None:
    """Read host and ``OWNER/NAME`` from the address of a git remote; None if it has another form.

    >>> parse_remote("git@github.com:lab/board.git"), parse_remote("https://github.com/lab/board")
    (('github.com', 'lab/board'), ('github.com', 'lab/board'))
    """
    if "://" in url:
        try:
            parts = urlsplit(url)
            host, path = parts.hostname or "", parts.path
        except ValueError:
            return None
    else:
        match = _SCP.fullmatch(url)
        if match is None:
            return None
        host, path = match["host"].lower(), match["path"]
    name = path.strip("/").removesuffix(".git")
    return (host, name) if host and is_repository_name(name) else None


def choose_repository(instance: Instance, named: str | None, api_url: str) -> str:
    """Return the repository that was named, or else the one that an instance was cloned from.

    Raises
    ------
    GitHubError
        If the name is none, or nothing is known.
    """
    if named is None:
        return find_repository(instance, api_url)
    if not is_repository_name(named):
        raise GitHubError(f"--repository {named!a} is not of the form OWNER/NAME", "such as lab/leaderboard")
    return named


def find_repository(instance: Instance, api_url: str) -> str:
    """Find the repository that an instance was cloned from, as ``OWNER/NAME``.

    Raises
    ------
    GitHubError
        If that is not known, or its host is not the API's.
    """
    for remote in REMOTES:
        url = GitRepository(instance.root).read_remote(remote)
        if url is None:
            continue
        found = parse_remote(url)
        if found is None:
            raise GitHubError(f"the git remote {remote} is no repository on GitHub", NAME_HINT)
        host, name = found
        if api_url == PUBLIC_API and host.removeprefix("ssh.") != web_host(api_url):
            message = f"the git remote {remote} is at {host}, and {api_url} is the API of another host"
            raise GitHubError(message, f"name its own: --api-url https://{host}/api/v3")
        return name
    message = f"which repository takes submissions is not known: {instance.root} has no git remote"
    raise GitHubError(message, NAME_HINT)


def find_prefix(instance: Instance) -> str:
    """Say where the instance lies within its repository: empty at its top, else with a slash at the end."""
    try:
        return GitRepository(instance.root).prefix()
    except GitError:
        return ""


def _is_safe(api_url: str) -> bool:
    try:
        parts = urlsplit(api_url)
        has_extras = bool(parts.query or parts.fragment or "@" in parts.netloc or parts.port == 0)
    except ValueError:
        return False
    is_private = parts.scheme == "https" or (parts.scheme == "http" and parts.hostname in _LOOPBACK)
    return (
        bool(parts.hostname) and is_private and not has_extras and api_url.isascii() and api_url.isprintable()
    )
