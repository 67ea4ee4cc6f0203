"""Looking at a built site on this machine."""

import threading
from http.client import HTTPConnection
from http.server import ThreadingHTTPServer
from pathlib import Path

import pytest

from leaderboard.errors import InstanceError
from leaderboard.website import open_server, serve_site


def test_a_site_is_served_to_this_machine_only(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """The server listens on the loopback address, takes a free port for 0, and gives the files."""
    (tmp_path / "index.html").write_text("hello")
    with open_server(tmp_path, 0) as server:
        assert server.server_address[0] == "127.0.0.1"
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        connection = HTTPConnection("127.0.0.1", server.server_port)
        connection.request("GET", "/")
        assert connection.getresponse().read() == b"hello"
        connection.close()
        server.shutdown()
        thread.join()
    assert '"GET / HTTP/1.1" 200' in capfd.readouterr().err


def test_a_port_in_use_is_named(tmp_path: Path) -> None:
    """The message says which port and what to do."""
    with open_server(tmp_path, 0) as server:
        port = server.server_port
        with pytest.raises(InstanceError, match=f"cannot serve on port {port}: ") as caught:
            open_server(tmp_path, port)
    assert caught.value.hint == "choose another one with --port"


def test_serving_ends_with_the_keyboard(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It says where to look, and an interrupt ends it without a traceback."""

    def interrupt(_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(ThreadingHTTPServer, "serve_forever", interrupt)
    serve_site(tmp_path, 0)
    said = capsys.readouterr().err
    assert f"Serving {tmp_path} at http://127.0.0.1:" in said
    assert said.endswith("Stopped.\n")
