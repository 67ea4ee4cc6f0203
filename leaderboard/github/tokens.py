"""The token that speaks for a participant: where it is found, and that it is never shown."""

import re
import shutil
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass, field

from leaderboard.errors import LeaderboardError

VARIABLES = ("GITHUB_TOKEN", "GH_TOKEN")
LONGEST_WAIT = 20  # seconds for `gh` to answer
_TOKEN = re.compile(r"[!-~]{8,2000}")


class TokenError(LeaderboardError):
    """There is no token, or what is there is none."""


@dataclass(frozen=True)
class Token:
    """A secret, and where it was found; only its origin is ever shown."""

    value: str = field(repr=False)
    origin: str

    def redact(self, text: str) -> str:
        """Leave the token out of a text."""
        return text.replace(self.value, "***")

    def is_in(self, content: bytes) -> bool:
        """Tell whether some bytes hold the token."""
        return self.value.encode() in content


def find_token(environment: Mapping[str, str], host: str) -> Token:
    """Find the token: in ``GITHUB_TOKEN``, in ``GH_TOKEN``, or where GitHub's own command line keeps it.

    Parameters
    ----------
    environment
        The process's variables.
    host
        Whose token it is to be, such as ``github.com``.

    Raises
    ------
    TokenError
        If there is none, or what is there cannot be one.
    """
    for name in VARIABLES:
        if value := environment.get(name, "").strip():
            return _make_token(value, name)
    if value := _ask_gh(host):
        return _make_token(value, "gh")
    message = f"no token for {host}: neither GITHUB_TOKEN nor GH_TOKEN is set, and gh has none to give"
    hint = "run gh auth login, or put a classic token with the scope public_repo into GITHUB_TOKEN"
    raise TokenError(message, hint)


def _make_token(value: str, origin: str) -> Token:
    if not _TOKEN.fullmatch(value):
        message = (
            f"what {origin} holds is no token: it is too short, too long, or has blanks or other characters"
        )
        raise TokenError(message, "copy it again, whole and without quotes")
    return Token(value, origin)


def _ask_gh(host: str) -> str:
    program = shutil.which("gh")
    if program is None:
        return ""
    try:
        done = subprocess.run(  # noqa: S603  (a fixed program; the host comes after its option)
            [program, "auth", "token", "--hostname", host],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=LONGEST_WAIT,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired, UnicodeDecodeError):
        return ""
    return done.stdout.strip() if done.returncode == 0 else ""
