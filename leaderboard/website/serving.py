"""Serving a built site on this machine, to look at it."""

import sys
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

from leaderboard.errors import InstanceError

HOST = "127.0.0.1"


def open_server(folder: Path, port: int) -> ThreadingHTTPServer:
    """Open a server that only this machine can reach; port 0 takes a free one.

    Raises
    ------
    InstanceError
        If the port cannot be used.
    """
    handler = partial(SimpleHTTPRequestHandler, directory=str(folder))
    try:
        return ThreadingHTTPServer((HOST, port), handler)
    except OSError as error:
        raise InstanceError(
            f"cannot serve on port {port}: {error.strerror or error}", "choose another one with --port"
        ) from error


def serve_site(folder: Path, port: int) -> None:
    """Serve a built site until interrupted, and say where."""
    with open_server(folder, port) as server:
        sys.stderr.write(f"Serving {folder} at http://{HOST}:{server.server_port}/ (Ctrl+C stops)\n")
        try:
            server.serve_forever()
        except KeyboardInterrupt:
            sys.stderr.write("\nStopped.\n")
