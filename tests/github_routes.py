"""How GitHub's API answers each operation that sending a submission uses."""

import base64
import json
import re
from collections.abc import Callable
from typing import Any

from github_contract import Call, fill
from github_hub import Hub, MissingObjectError, Pull, Repo

Answer = tuple[int, Any]
USER_IDS = {"someone": 4711, "lab": 12}


def refuse(status: int, message: str, *errors: dict[str, str]) -> Answer:
    """Answer as GitHub does when it refuses."""
    about = {"message": message, "documentation_url": "https://docs.github.com/rest", "status": str(status)}
    return status, about | ({"errors": list(errors)} if errors else {})


def answer(hub: Hub, call: Call, login: str) -> Answer:
    """Do what a request asks for, as somebody with an account."""
    if call.path == "/user":
        return 200, fill("public-user", {"login": login, "id": USER_IDS.get(login, 1)})
    match = re.fullmatch(r"/repos/([^/]+/[^/]+)(/.*)?", call.path)
    repo = hub.find(match[1]) if match else None
    if match is None or repo is None:
        return refuse(404, "Not Found")
    rest = match[2] or ""
    if rest.startswith("/git/") and repo.checks_until_ready:
        repo.checks_until_ready -= 1
        return refuse(409, "Git Repository is empty.")
    for (method, pattern), route in ROUTES.items():
        found = re.fullmatch(pattern, rest)
        if method == call.method and found:
            owner = repo.full_name.partition("/")[0].lower()
            if method != "GET" and rest.startswith(("/git/", "/merge-")) and owner != login:
                return refuse(403, "Must have push access to repository")
            return route(hub, repo, call, login, *found.groups())
    return refuse(404, "Not Found")


def _read(call: Call) -> dict[str, Any]:
    content: dict[str, Any] = json.loads(call.content)
    return content


def _show_repo(repo: Repo) -> dict[str, Any]:
    owner, _, name = repo.full_name.partition("/")
    about: dict[str, Any] = {
        "full_name": repo.full_name,
        "name": name,
        "owner": {"login": owner, "id": USER_IDS.get(owner, 1)},
        "default_branch": repo.default_branch,
        "fork": repo.parent is not None,
        "archived": repo.archived,
        "allow_forking": repo.allow_forking,
    }
    if repo.parent is not None:
        parent = fill("repository", {"full_name": repo.parent, "default_branch": "main"})
        about |= {"parent": parent, "source": parent}
    return fill("full-repository", about)


def _get_repo(hub: Hub, repo: Repo, call: Call, login: str) -> Answer:
    del hub, call, login
    return 200, _show_repo(repo)


def _fork(hub: Hub, repo: Repo, call: Call, login: str) -> Answer:
    del call
    if not repo.allow_forking:
        return refuse(403, "The repository exists, but forking is disabled.")
    return 202, _show_repo(hub.find_fork(repo.full_name, login) or hub.fork(repo, login))


def _synchronize(hub: Hub, repo: Repo, call: Call, login: str) -> Answer:
    del login
    branch = _read(call)["branch"]
    upstream = hub.repos[repo.parent or ""]
    try:
        repo.git("fetch", "-q", str(upstream.folder), f"{branch}:{branch}")
    except MissingObjectError:
        return refuse(409, "There are merge conflicts")
    return 200, {
        "message": "Successfully fetched",
        "merge_type": "fast-forward",
        "base_branch": f"x:{branch}",
    }


def _list_folder(hub: Hub, repo: Repo, call: Call, login: str, path: str) -> Answer:
    del hub, login
    found = repo.list_folder(call.query["ref"], path)
    if not found:
        return refuse(404, "Not Found")
    return 200, [
        {
            "type": "file" if kind == "blob" else "dir",
            "sha": sha,
            "size": size,
            "name": name.rpartition("/")[2],
            "path": name,
            **dict.fromkeys(("git_url", "html_url", "download_url")),
            "url": "https://github.example/x",
            "_links": {"git": None, "html": None, "self": "https://github.example/x"},
        }
        for kind, sha, size, name in found
    ]


def _compare(hub: Hub, repo: Repo, call: Call, login: str, base: str, head: str) -> Answer:
    del hub, call, login
    try:
        start = repo.git("merge-base", base, head).decode().strip()
        names = repo.git("diff-tree", "-r", "-z", "--name-only", start, head).decode().split("\0")[:-1]
    except MissingObjectError:
        return refuse(404, "Not Found")
    files = [fill("diff-entry", {"filename": name, "sha": "0" * 40}) for name in names]
    return 200, fill("commit-comparison", {"files": files})


def _make_blob(hub: Hub, repo: Repo, call: Call, login: str) -> Answer:
    del hub, login
    content = _read(call)
    assert content["encoding"] == "base64"
    data = base64.b64decode(content["content"], validate=True)
    sha = repo.git("hash-object", "-w", "--stdin", content=data).decode().strip()
    return 201, fill("short-blob", {"sha": sha})


def _make_tree(hub: Hub, repo: Repo, call: Call, login: str) -> Answer:
    del hub, login
    content = _read(call)
    try:
        sha = repo.write_tree(content["base_tree"], content["tree"])
    except MissingObjectError:
        return refuse(404, "Not Found")
    return 201, fill("git-tree", {"sha": sha, "tree": []})


def _show_commit(repo: Repo, commit: str) -> dict[str, Any]:
    tree, parents = repo.read_commit(commit)
    shown = [
        {"sha": parent, "url": "https://github.example/x", "html_url": "https://github.example/x"}
        for parent in parents
    ]
    return fill("git-commit", {"sha": commit, "tree": {"sha": tree}, "parents": shown})


def _make_commit(hub: Hub, repo: Repo, call: Call, login: str) -> Answer:
    del hub, login
    content = _read(call)
    if any(repo.find(f"{name}^{{object}}") is None for name in (content["tree"], *content["parents"])):
        return refuse(422, "Tree SHA does not exist")
    commit = repo.write_commit(content["tree"], content["parents"], content["message"], content["author"])
    return 201, _show_commit(repo, commit)


def _get_commit(hub: Hub, repo: Repo, call: Call, login: str, sha: str) -> Answer:
    del hub, call, login
    if repo.find(f"{sha}^{{commit}}") is None:
        return refuse(404, "Not Found")
    return 200, _show_commit(repo, sha)


def _show_ref(repo: Repo, branch: str) -> dict[str, Any]:
    about = {"type": "commit", "sha": repo.branch(branch)}
    return fill("git-ref", {"ref": f"refs/heads/{branch}", "object": about})


def _get_ref(hub: Hub, repo: Repo, call: Call, login: str, branch: str) -> Answer:
    del hub, call, login
    return (200, _show_ref(repo, branch)) if repo.branch(branch) else refuse(404, "Not Found")


def _make_ref(hub: Hub, repo: Repo, call: Call, login: str) -> Answer:
    del hub, login
    content = _read(call)
    branch = content["ref"].removeprefix("refs/heads/")
    if repo.branch(branch) is not None:
        return refuse(422, "Reference already exists")
    if repo.find(f"{content['sha']}^{{commit}}") is None:
        return refuse(422, "Object does not exist")
    repo.set_branch(branch, content["sha"])
    return 201, _show_ref(repo, branch)


def _move_ref(hub: Hub, repo: Repo, call: Call, login: str, branch: str) -> Answer:
    del hub, login
    content = _read(call)
    if repo.branch(branch) is None:
        return refuse(422, "Reference does not exist")
    if not content["force"]:
        return refuse(422, "Update is not a fast forward")
    repo.set_branch(branch, content["sha"])
    return 200, _show_ref(repo, branch)


def _show_pull(pull: Pull, kind: str) -> dict[str, Any]:
    return fill(
        kind,
        {
            "number": pull.number,
            "head": {"label": pull.head},
            "html_url": f"https://github.example/{pull.repo}/pull/{pull.number}",
            "state": pull.state,
            "title": pull.title,
            "body": pull.body,
            "merged_at": pull.merged_at,
        },
    )


def _list_pulls(hub: Hub, repo: Repo, call: Call, login: str) -> Answer:
    del login
    query = call.query
    found = [
        pull
        for pull in reversed(hub.pulls)
        if (pull.repo, pull.head, pull.base) == (repo.full_name, query["head"], query["base"])
        and query["state"] in {"all", pull.state}
    ]
    return 200, [_show_pull(pull, "pull-request-simple") for pull in found]


def _open_pull(hub: Hub, repo: Repo, call: Call, login: str) -> Answer:
    del login
    content = _read(call)
    owner, _, branch = content["head"].partition(":")
    fork = hub.find_fork(repo.full_name, owner)
    head = fork.branch(branch) if fork else None
    wrong = {"resource": "PullRequest", "field": "head"}
    if fork is None or head is None:
        return refuse(422, "Validation Failed", wrong | {"code": "invalid"})
    if any((p.repo, p.head, p.state) == (repo.full_name, content["head"], "open") for p in hub.pulls):
        message = f"A pull request already exists for {content['head']}."
        return refuse(422, "Validation Failed", wrong | {"code": "custom", "message": message})
    pull = Pull(
        len(hub.pulls) + 1,
        repo.full_name,
        content["head"],
        content["base"],
        content["title"],
        content["body"],
    )
    hub.pulls.append(pull)
    return 201, _show_pull(pull, "pull-request")


def _change_pull(hub: Hub, repo: Repo, call: Call, login: str, number: str) -> Answer:
    del repo, login
    pull = next(pull for pull in hub.pulls if pull.number == int(number))
    pull.body = _read(call)["body"]
    return 200, _show_pull(pull, "pull-request")


ROUTES: dict[tuple[str, str], Callable[..., Answer]] = {
    ("GET", ""): _get_repo,
    ("POST", "/forks"): _fork,
    ("POST", "/merge-upstream"): _synchronize,
    ("GET", "/contents/(.+)"): _list_folder,
    ("GET", r"/compare/([0-9a-f]{40})\.\.\.([0-9a-f]{40})"): _compare,
    ("POST", "/git/blobs"): _make_blob,
    ("POST", "/git/trees"): _make_tree,
    ("POST", "/git/commits"): _make_commit,
    ("GET", "/git/commits/([0-9a-f]{40})"): _get_commit,
    ("GET", "/git/ref/heads/(.+)"): _get_ref,
    ("POST", "/git/refs"): _make_ref,
    ("PATCH", "/git/refs/heads/(.+)"): _move_ref,
    ("GET", "/pulls"): _list_pulls,
    ("POST", "/pulls"): _open_pull,
    ("PATCH", "/pulls/([0-9]+)"): _change_pull,
}
