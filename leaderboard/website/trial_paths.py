"""Where the pages of trials are: trial ids hold slashes and other signs that addresses should not."""

import re

from leaderboard.files import sha256_hex

TRIALS_PATH = "trials/index.html"
TRIALS_TABLE = "trials.csv"
MAX_WORDS = 64
N_HASH_DIGITS = 12

_NO_WORD = re.compile("[^a-z0-9]+")


def list_path(property_name: str) -> str:
    """Say where the list of a property's trials is.

    >>> list_path("Mass")
    'trials/of/mass.html'
    """
    return f"trials/of/{property_name.lower()}.html"


def choice_path(key: str) -> str:
    """Say where the list of trials that were chosen by answers is.

    >>> choice_path("easy")
    'trials/where/easy.html'
    """
    return f"trials/where/{key}.html"


def trial_path(trial_id: str) -> str:
    """Say where a trial's page is: a folder named in words, and by the id's hash, which tells all ids apart.

    >>> trial_path("mass-copy0/target=bowl-tscale=0.3,0.5/0001")
    'trials/mass-copy0-target-bowl-tscale-0-3-0-5-0001-9e4aa68ceeb5/index.html'
    """
    words = _NO_WORD.sub("-", trial_id.lower()).strip("-")
    if len(words) > MAX_WORDS:
        words = words[-MAX_WORDS:].partition("-")[2]  # from the beginning of a word
    name = f"{words}-{_hash(trial_id)}" if words else _hash(trial_id)
    return f"trials/{name}/index.html"


def trial_anchor(trial_id: str) -> str:
    """Name the row of the list of trials that begins with a trial.

    >>> trial_anchor("mass-copy0/target=bowl-tscale=0.3,0.5/0001")
    'trial-9e4aa68ceeb5'
    """
    return f"trial-{_hash(trial_id)}"


def scenario_anchor(scenario_id: str) -> str:
    """Name the part of the list of trials that holds a scenario.

    >>> scenario_anchor("mass_dominoes_pp")
    'scenario-mass_dominoes_pp'
    """
    return f"scenario-{scenario_id}"


def _hash(trial_id: str) -> str:
    return sha256_hex(trial_id.encode())[:N_HASH_DIGITS]
