"""A web server on this machine that serves a stand-in of the release, faithfully or with faults.

Use it so::

    with ReleaseServer({"/test_data.zip": test_zip, "/human_data.zip": human_zip}) as server:
        server.set_faults("/human_data.zip", Fault(status=503, times=2), Fault(cut_after=1000, times=1))
        fetch(server.url("/test_data.zip"), server.url("/human_data.zip"))
        assert server.bytes_sent["/test_data.zip"] < 2_000_000
        assert server.requests["/human_data.zip"] == 4
"""

import threading
from types import TracebackType
from typing import Self

from release_handler import SiteServer
from release_site import Content, Fault, Seen, Site

__all__ = ["Content", "Fault", "ReleaseServer", "Seen", "Site"]


class ReleaseServer(Site):
    """Serves a site on the loopback address while its ``with`` block lasts."""

    def __enter__(self) -> Self:
        self._http = SiteServer(self)
        self._thread = threading.Thread(target=self._http.serve_forever, args=(0.01,), daemon=True)
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.is_closing.set()
        self._http.shutdown()
        self._thread.join()
        self._http.close_connections()
        self._http.server_close()

    @property
    def address(self) -> str:
        """Where the server is, as a URL without a path; it answers as a proxy for any other host too."""
        return f"http://127.0.0.1:{self._http.server_port}"

    def url(self, path: str) -> str:
        """Return the URL of a path."""
        return self.address + path
