"""A server for a built site, and a tab that notes whatever a page does that it should not."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

from playwright.sync_api import Browser, Page, Request, Response

FIRST_ERROR = 400


class _QuietHandler(SimpleHTTPRequestHandler):
    def log_message(self, format: str, *args: object) -> None:  # noqa: A002 - the name is the library's
        """Say nothing: a test's output is its failures."""


@contextmanager
def serve_folder(folder: Path) -> Iterator[str]:
    """Serve a folder on this machine and give its address."""
    with ThreadingHTTPServer(("127.0.0.1", 0), partial(_QuietHandler, directory=str(folder))) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()
        thread.join()


@dataclass
class Visit:
    """A tab on a site, and what it complained about so far."""

    page: Page
    origin: str
    complaints: list[str] = field(default_factory=list)

    def open(self, path: str) -> Page:
        """Open a page of the site."""
        self.page.goto(f"{self.origin}/{path}")
        return self.page

    def watch(self) -> None:
        """Note requests that leave the site or fail, errors, and anything on the console."""
        self.page.on("request", self._check_request)
        self.page.on("response", self._check_response)
        self.page.on("requestfailed", self._check_failure)
        self.page.on("console", lambda message: self.complaints.append(f"console: {message.text}"))
        self.page.on("pageerror", lambda error: self.complaints.append(f"error: {error}"))

    def _check_request(self, request: Request) -> None:
        if not request.url.startswith(f"{self.origin}/"):
            self.complaints.append(f"leaves the site: {request.url}")

    def _check_failure(self, request: Request) -> None:
        # Leaving a page gives up what it still loads, such as its icon: that is no fault of the page.
        if request.failure != "net::ERR_ABORTED":
            self.complaints.append(f"failed: {request.url} ({request.failure})")

    def _check_response(self, response: Response) -> None:
        if response.status >= FIRST_ERROR:
            self.complaints.append(f"status {response.status}: {response.url}")


def start_visit(browser: Browser, origin: str, *, width: int = 1280, javascript: bool = True) -> Visit:
    """Open a tab of its own, watched from the start."""
    context = browser.new_context(viewport={"width": width, "height": 900}, java_script_enabled=javascript)
    visit = Visit(context.new_page(), origin)
    visit.watch()
    return visit
