"""What a stranger may write, meant for a browser, a terminal, a log, a spreadsheet, LaTeX or Markdown."""

import re

# Printable, so that they are taken as they are and must stay text wherever they are shown.
PRINTABLE = {
    "element": "<img src=x onerror=alert(1)>",
    "script": '"></th></table><script>alert(2)</script>',
    "attribute": "' onmouseover=alert(3) x='",
    "drawing": "</title></svg><svg onload=alert(4)>",
    "comment": "--> <!-- ]]> <![CDATA[ -->",
    "entity": "&lt;b&gt; &#60;i&#62; &amp;amp;",
    "style": "</style><style>*{display:none}</style>",
    "template": "{{ 7 * 7 }} {% raw %} ${7*7} #{7*7}",
    "script link": "javascript:alert(5)",
    "data link": "data:text/html,<script>alert(6)</script>",
    "markdown link": "[a](https://x.example) ![b](https://x.example/b.png)",
    "mention": "@everyone closes #1, fixes lab/board#2",
    "heading": "# Title",
    "fence": "``` ```` ~~~~",
    "long fence": "`" * 80,
    "cells": "| a | b |",
    "command": "::error file=a,line=1::x",
    "stop command": "::stop-commands::x",
    "older command": "##[add-mask]x",
    "escaped command": "%0A::error::x",
    "formula": '=HYPERLINK("https://x.example","y")',
    "plus": "+1+cmd|' /C calc'!A0",
    "minus": "-2+3",
    "at": "@SUM(A1:A9)",
    "wide formula": "\uff1d1+1",
    "wide at": "\uff20SUM(A1:A9)",
    "quotes": 'a","b\'; "c',
    "separator": "a;=1+1",
    "latex": r"\input{/etc/passwd} $x$ % & # _ ^ ~ {",
    "latex end": r"\end{tabular} \\ [1em]",
    "markup": "[bold red]x[/] [link=https://x.example]y[/link] :smile:",
    "escapes": r"\" \n \u202e \x1b[2J",
    "shell": "$(touch x) `touch y`; rm -rf -- *",
    "option": "--output=/etc/passwd",
    "path": "../../../etc/passwd",
    "right to left": "\u05d0\u05d1\u05d2 123 \u062f\u0647\u0648",
    "look-alike": "\u041c\u0430ss",
}

# What no text may hold.
FORBIDDEN = {
    "terminal": "a\x1b[2Jb",
    "terminal's title": "\x1b]0;a\x07",
    "one-byte escape": "a\x9b31mb",
    "line": "a\n::error::b",
    "return": "a\r::error::b",
    "tab": "a\tb",
    "nothing": "a\0b",
    "backspace": "a\x08b",
    "next line": "a\x85::error::b",
    "line separator": "a\u2028b",
    "paragraph separator": "a\u2029b",
    "override": "a\u202eb",
    "isolate": "a\u2066b",
    "direction mark": "a\u200fb",
    "zero-width space": "a\u200bb",
    "joiner": "a\u200db",
    "word joiner": "a\u2060b",
    "byte-order mark": "a\ufeffb",
    "soft hyphen": "a\u00adb",
    "grapheme joiner": "a\u034fb",
    "filler": "\u3164",
    "blank pattern": "\u2800",
    "variation": "a\ufe0fb",
    "tag": "a\U000e0041b",
    "private": "a\ue000b",
    "noncharacter": "a\uffffb",
    "stacked marks": "a" + "\u0336" * 20,
    "decomposed": "e\u0301",
    "10,000 characters": "x" * 10_000,
}

# Links that lead elsewhere than they seem to, or run something.
BAD_LINKS = (
    "javascript:alert(1)",
    "JaVaScRiPt:alert(1)//https://x.example",
    " javascript:alert(1)",
    "java\tscript:alert(1)",
    "data:text/html,<script>alert(1)</script>",
    "vbscript:msgbox(1)",
    "file:///etc/passwd",
    "//x.example/a",
    "https:///a",
    "https:x.example",
    "https://somebody:word@x.example",
    "https://github.com@x.example",
    "https://x.example\\@y.example",
    "https://\u0435xample.com",
    "https://x.example/\u202ea",
    "https://x.example/a b",
    'https://x.example/"onmouseover=alert(1)',
    "https://x.example/<script>",
    "https://[",
    "https://x.example/" + "a" * 10_000,
)

MAX_LINE = 1000


def check_lines(text: str) -> None:
    """No line steers a terminal, is a command to the host that runs the check, or is too long to read."""
    assert text.endswith("\n") or not text
    for line in text.split("\n"):
        assert line.isprintable(), ascii(line)
        assert not line.lstrip().startswith("::"), line
        assert "##[" not in line, line
        assert len(line) <= MAX_LINE


def outside_of_fences(page: str) -> str:
    """What a page holds besides its code fences, read as Markdown does."""
    left, end = [], None
    for line in page.split("\n"):
        if end is None:
            opening = re.match(r"`{3,}|~{3,}", line)
            end = opening.group() if opening else None
            left += [] if opening else [line]
        elif line.startswith(end) and not line.strip("`"):
            end = None
    assert end is None
    return "\n".join(left)
