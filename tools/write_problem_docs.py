"""Write docs/problems.md from the catalogue of problem codes; a test says whether it is up to date."""

from pathlib import Path

from leaderboard.files import write_atomic
from leaderboard.problems import CODES, Severity

CHANGE, LEDGER, REFERENCE, IMPORT = "change-", "ledger-", "reference-", "import-"

HEAD = """\
# Problems: every code and its meaning

Written by `python tools/write_problem_docs.py` from `leaderboard/problems/`; change it there.

A message reads `file:line: code: what was found`, with a hint below it that says what to do. **Errors**
refuse, **warnings** and **notes** inform. `leaderboard validate --json` gives all of them as data.
"""

# A section's title, the codes that belong there by prefix and severity, and what follows from them.
SECTIONS = (
    (
        "Submissions: errors",
        "",
        Severity.ERROR,
        "`leaderboard validate`, `grade` and `submit` refuse the submission.",
    ),
    (
        "Submissions: warnings",
        "",
        Severity.WARNING,
        "The submission is graded all the same; its `result.json` keeps them under `checks`.",
    ),
    (
        "Branches: errors",
        CHANGE,
        Severity.ERROR,
        "`leaderboard check-changes` says that the branch must not be merged as it is.",
    ),
    (
        "Branches: warnings",
        CHANGE,
        Severity.WARNING,
        "`leaderboard check-changes` mentions them for whoever reviews.",
    ),
    (
        "The ledger: errors",
        LEDGER,
        Severity.ERROR,
        "`leaderboard ledger` names them; nothing is published with such a ledger.",
    ),
    (
        "References: errors",
        REFERENCE,
        Severity.ERROR,
        "`leaderboard reference check` names them; nothing is graded with such a reference.",
    ),
    (
        "References: warnings",
        REFERENCE,
        Severity.WARNING,
        "`leaderboard reference check` fails: the files are not as the definition expects.",
    ),
    (
        "References: notes",
        REFERENCE,
        Severity.NOTE,
        "`leaderboard reference check` mentions them and passes.",
    ),
    (
        "Importing official files: errors",
        IMPORT,
        Severity.ERROR,
        "`leaderboard reference import` and `fetch` refuse the files; the reference stays as it is.",
    ),
    (
        "Importing official files: warnings",
        IMPORT,
        Severity.WARNING,
        "`leaderboard reference import` goes on; each says what became of its rows.",
    ),
    (
        "Importing official files: notes",
        IMPORT,
        Severity.NOTE,
        "`leaderboard reference import` mentions them.",
    ),
)


def render_problem_docs() -> str:
    """Lay the catalogue out as the page: a section for each origin and severity, codes in their own order."""
    parts = [HEAD]
    for title, prefix, severity, consequence in SECTIONS:
        rows = [
            f'| <a id="{name}"></a>`{name}` | {code.meaning} |\n'
            for name, code in CODES.items()
            if code.severity is severity and _prefix_of(name) == prefix
        ]
        table = "".join(["| code | meaning |\n|---|---|\n", *rows])
        parts.append(f"\n## {title}\n\n{consequence}\n\n{table}")
    return "".join(parts)


def _prefix_of(name: str) -> str:
    return next((prefix for prefix in (CHANGE, LEDGER, REFERENCE, IMPORT) if name.startswith(prefix)), "")


if __name__ == "__main__":
    write_atomic(Path(__file__).parent.parent / "docs/problems.md", render_problem_docs().encode())
