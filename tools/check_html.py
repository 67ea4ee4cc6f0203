"""Hold every page and figure of a built site against the standards: `python tools/check_html.py site/dist`.

The checker is vnu, which is behind the validator of the W3C; `make checker` installs it. It needs Java and no
network.
"""

import json
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
JAR = ROOT / ".venv" / "html-checker" / "node_modules" / "vnu-jar" / "build" / "dist" / "vnu.jar"
# Figures make the parser go deep; a simple collector and compiler halve the work on few cores.
JAVA_OPTIONS = ["-Xss4m", "-XX:+UseSerialGC", "-XX:TieredStopAtLevel=1"]
OPTIONS = [
    "--errors-only",
    "--skip-non-html",
    "--also-check-svg",
    "--format",
    "json",
    "--stdout",
    "--exit-zero-always",
]


def name_missing() -> str:
    """Say what is not here that the checker needs; nothing if all is."""
    if shutil.which("java") is None:
        return "java is not there: install Java 11 or newer"
    return "" if JAR.is_file() else f"{JAR.relative_to(ROOT)} is not there: `make checker` installs it"


def find_errors(folder: Path) -> list[str]:
    """Name every error in the pages and figures of a folder, with place and the text around it.

    Raises
    ------
    RuntimeError
        If the checker does not come to an end.
    """
    command = ["java", *JAVA_OPTIONS, "-jar", str(JAR), *OPTIONS, str(folder)]
    done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", check=False)
    if done.returncode:
        raise RuntimeError(f"the HTML checker ended with {done.returncode}: {done.stderr.strip()[-500:]}")
    start = f"{folder.as_uri().replace('///', '/')}/"
    return [
        f"{message.get('url', '').removeprefix(start)}:{message.get('lastLine', '')}: {message['message']}"
        f" {message.get('extract', '').strip()!r}"
        for message in json.loads(done.stdout)["messages"]
    ]


def main(folder: Path) -> int:
    """Print all errors of a built site; the exit status tells whether there are any."""
    missing = name_missing()
    if missing:
        sys.exit(missing)
    errors = find_errors(folder.resolve())
    print(*errors, f"{len(errors)} errors", sep="\n")
    return 1 if errors else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:  # noqa: PLR2004 - the command and its folder
        sys.exit("usage: python tools/check_html.py FOLDER")
    sys.exit(main(Path(sys.argv[1])))
