"""A double of GitHub on this machine: bare repositories behind its API, held against its own description.

Use it so::

    with GitHubDouble(hub, {"secret-token": "someone"}) as github:
        github.faults.append(Fault(on=3, kind="drop"))
        send(github.api_url)
        assert [str(call) for call in github.calls] == ["GET /user", ...]

Leaving the block fails if any request or answer was not as GitHub describes it.
"""

import json
import threading
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from types import TracebackType
from typing import Literal, Self
from urllib.parse import parse_qsl, unquote, urlsplit

from github_contract import Call, find_violation
from github_hub import Hub
from github_routes import Answer, answer, refuse

API_PATH = "/api/v3"


@dataclass(frozen=True)
class Fault:
    """What goes wrong with one request, counted from 1, or with all whose line starts so.

    ``drop`` breaks the connection before anything is done, ``lose`` when it is done; ``hang`` and ``stall``
    keep it and say nothing, likewise; ``answer`` answers with the status, headers and content given.
    """

    on: int | str
    kind: Literal["drop", "lose", "hang", "stall", "answer"] = "answer"
    status: int = 500
    headers: dict[str, str] = field(default_factory=dict)
    content: bytes = b"{}"
    times: int = 1_000_000


class GitHubDouble:
    """Serves a hub on the loopback address while its ``with`` block lasts.

    Attributes
    ----------
    calls
        All requests to the API.
    faults
        What is to go wrong; the first that fits counts.
    violations
        What was not as GitHub describes it.
    is_silent
        Set once a request gets no answer.
    """

    def __init__(self, hub: Hub, tokens: dict[str, str]) -> None:
        self.hub = hub
        self.tokens = tokens
        self.scopes = "gist, public_repo"
        self.calls: list[Call] = []
        self.faults: list[Fault] = []
        self.violations: list[str] = []
        self.is_closing = threading.Event()
        self.is_silent = threading.Event()
        self.lock = threading.Lock()
        self._used: dict[int, int] = {}

    def __enter__(self) -> Self:
        handler = type("Handler", (_Handler,), {"github": self})
        self._server = ThreadingHTTPServer(("127.0.0.1", 0), handler)
        self._server.daemon_threads = True
        self._thread = threading.Thread(target=self._server.serve_forever, args=(0.01,), daemon=True)
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.is_closing.set()
        self._server.shutdown()
        self._thread.join()
        self._server.server_close()
        if kind is None:
            assert not self.violations, "\n".join(self.violations)

    @property
    def address(self) -> str:
        """Where its web pages would be, and its repositories are for ``git clone``."""
        return f"http://127.0.0.1:{self._server.server_port}"

    @property
    def api_url(self) -> str:
        """Where its API is."""
        return f"{self.address}{API_PATH}"

    def find_fault(self, call: Call) -> Fault | None:
        """Choose what goes wrong with the newest request."""
        for index, fault in enumerate(self.faults):
            fits = (
                str(call).startswith(fault.on) if isinstance(fault.on, str) else fault.on == len(self.calls)
            )
            if fits and self._used.get(index, 0) < fault.times:
                self._used[index] = self._used.get(index, 0) + 1
                return fault
        return None

    def judge(self, call: Call, given: Answer | None = None) -> None:
        """Hold a request or an answer against the description."""
        violation = find_violation(call, given)
        self.violations += [violation] if violation else []

    def answer(self, call: Call, authorization: str) -> Answer:
        """Do what is asked, if who asks is known."""
        login = self.tokens.get(authorization.removeprefix("Bearer "))
        if login is None:
            return refuse(401, "Bad credentials")
        self.judge(call)
        given = answer(self.hub, call, login)
        self.judge(call, given)
        return given


class _Handler(BaseHTTPRequestHandler):
    github: GitHubDouble

    def do_GET(self) -> None:
        parts = urlsplit(self.path)
        if parts.path.startswith(f"{API_PATH}/"):
            self._serve()
        else:
            self._serve_file(parts.path)

    def do_POST(self) -> None:
        self._serve()

    def do_PATCH(self) -> None:
        self._serve()

    def log_message(self, *_: object) -> None:
        """Say nothing."""

    def _serve(self) -> None:
        parts = urlsplit(self.path)
        content = self.rfile.read(int(self.headers.get("Content-Length", 0)))
        path = unquote(parts.path.removeprefix(API_PATH))
        call = Call(self.command, path, dict(parse_qsl(parts.query)), content)
        with self.github.lock:
            self.github.calls.append(call)
            fault = self.github.find_fault(call)
            is_done = fault is None or fault.kind in {"lose", "stall"}
            given = self.github.answer(call, self.headers.get("Authorization", "")) if is_done else None
        if fault is None and given is not None:
            status, content = given[0], json.dumps(given[1]).encode()
            self._send(
                status, content, {"X-OAuth-Scopes": self.github.scopes, "X-RateLimit-Remaining": "4999"}
            )
        elif fault is not None and fault.kind == "answer":
            self._send(fault.status, fault.content, fault.headers)
        elif fault is not None and fault.kind in {"hang", "stall"}:
            self.github.is_silent.set()
            self.github.is_closing.wait()

    def _send(self, status: int, content: bytes, headers: dict[str, str]) -> None:
        self.send_response(status)
        for name, value in headers.items():
            self.send_header(name, value)
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        self.wfile.write(content)

    def _serve_file(self, path: str) -> None:
        """Serve a repository's files, which is all that git needs to clone it."""
        owner, _, rest = path.lstrip("/").partition("/")
        name, _, file = rest.partition("/")
        repo = self.github.hub.find(f"{owner}/{name.removesuffix('.git')}")
        place = repo.folder / file if repo else None
        if repo is None or place is None or ".." in file:
            self._send(404, b"", {})
            return
        repo.git("update-server-info")
        if place.is_file():
            self._send(200, place.read_bytes(), {})
        else:
            self._send(404, b"", {})
