"""Audited numbers as text and JSON."""

import json
from typing import Any

from leaderboard.auditing import FLAGS, audit
from leaderboard.models.published import PublishedNumber
from leaderboard.report.audit import render_audit, render_audit_json
from leaderboard.report.terminal import ABSENT, Terminal

PLAIN: dict[str, Any] = {"source": "A paper", "system": "Net", "training": "unified", "training_trials": 2000}
NUMBERS = [
    PublishedNumber(**PLAIN, scope="Mass", metric="accuracy", printed="67.1", n=192),
    PublishedNumber(**PLAIN, scope="Friction", metric="accuracy", printed="53.8", n=192),
    PublishedNumber(**PLAIN, scope="overall", metric="accuracy", printed="62.0", n=384),
    PublishedNumber(source="Another", system="People", scope="overall", metric="accuracy", printed="60%"),
    PublishedNumber(
        source="Another", system="Net", scope="Mass", metric="human_r", printed="0.12", note="text"
    ),
]


def test_each_source_and_protocol_has_a_table() -> None:
    """What was found stands beside what is printed; flags are counted and explained below."""
    text = render_audit(audit(NUMBERS), terminal=Terminal(200))
    expected = f"""\
A paper: unified, 2,000 training trials

 system  scope     printed        right of n       95 %       p  mean of parts  flags
 ───────────────────────────────────────────────────────────────────────────────────────────────────────────
 Net     Mass         67.1        129 of 192  60.3-73.4  <0.001              -  truncated
 Net     Friction     53.8  (103-104) of 192  46.6-61.1   0.348              -  impossible, not-above-chance
 Net     overall      62.0        238 of 384  57.0-66.7  <0.001          60.45  not-the-mean

Another: protocol not known

 system  scope    printed  right of n  95 %  p  mean of parts  flags
 ───────────────────────────────────────────────────────────────────────
 People  overall      60%           -     -  -              -  n-unknown

Another: protocol not known (text)

 system  scope           printed  right of n  95 %  p  mean of parts  flags
 ──────────────────────────────────────────────────────────────────────────
 Net     Mass (human_r)     0.12           -     -  -              -

5 numbers:
    1 impossible: {FLAGS["impossible"]}
    1 truncated: {FLAGS["truncated"]}
    1 not-the-mean: {FLAGS["not-the-mean"]}
    1 not-above-chance: {FLAGS["not-above-chance"]}
    1 n-unknown: {FLAGS["n-unknown"]}

right of n: the whole numbers that give the figure, in brackets its neighbours if none does; \
95 %: Wilson interval of such a share; p: exact, two-sided, against coin flips.
"""
    assert text.replace(ABSENT, "-") == expected


def test_a_narrow_terminal_has_fewer_columns_and_whole_flags() -> None:
    """Intervals, p and means give way; no flag is broken."""
    lines = render_audit(audit(NUMBERS), terminal=Terminal(80)).splitlines()
    assert all(len(line) <= 80 for line in lines)
    assert " system  scope     printed        right of n  flags" in lines
    assert " Net     Friction     53.8  (103-104) of 192  impossible, not-above-chance" in lines


def test_nothing_to_say_is_said() -> None:
    """Without flags the last line is short."""
    sound = PublishedNumber(**PLAIN, scope="Mass", metric="accuracy", printed="67.2", n=192)
    assert "\n1 number, none with a flag\n" in render_audit(audit([sound]))


def test_json_has_what_the_table_has() -> None:
    """Shares in [0, 1], counts as first and last, null where a question does not apply."""
    data = json.loads(render_audit_json(audit(NUMBERS)))
    assert data["flags"] == {
        "impossible": 1,
        "truncated": 1,
        "not-the-mean": 1,
        "not-above-chance": 1,
        "n-unknown": 1,
    }
    first, *_, last = data["numbers"]
    assert first["rights"] == {
        "fit": "truncated",
        "counts": [129, 129],
        "low": 0.602658,
        "high": 0.73435,
        "p": 2e-06,
    }
    assert (first["printed"], first["value"], first["n"], first["flags"]) == (
        "67.1",
        0.671,
        192,
        ["truncated"],
    )
    assert data["numbers"][2]["mean_of_parts"] == 0.6045
    assert (last["rights"], last["mean_of_parts"], last["n_parts"], last["flags"]) == (None, None, 0, [])


def test_a_tiny_p_is_not_zero() -> None:
    """It keeps its digits where rounding would make it 0."""
    certain = PublishedNumber(**PLAIN, scope="Mass", metric="accuracy", printed="100", n=192)
    assert json.loads(render_audit_json(audit([certain])))["numbers"][0]["rights"]["p"] == 3.18618e-58
