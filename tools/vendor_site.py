"""Copy what the website takes from npm into the tree: `make vendor`, or `python tools/vendor_site.py`.

`tools/vendor/package-lock.json` holds exact versions with their checksums, and npm refuses a package that
differs. Scripts of packages do not run. What is copied is committed, so building and installing need no npm.
"""

import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from leaderboard.files import canonical_json, sha256_hex

ROOT = Path(__file__).resolve().parent.parent
LOCK_DIR = ROOT / "tools" / "vendor"
LOCK_FILES = ("package.json", "package-lock.json", ".npmrc")
VENDOR_DIR = ROOT / "leaderboard" / "website" / "static" / "vendor"
MANIFEST_FILE = VENDOR_DIR / "manifest.json"

# Of each package: its files, and the names that they get here.
TAKEN = {
    "datatables.net": {
        "js/dataTables.min.js": "datatables.js",
        "License.txt": "datatables-license.txt",
    },
}


def main() -> None:
    """Install what the lock holds into a folder that goes away, and copy the files that are wanted."""
    npm = shutil.which("npm") or sys.exit("npm is not here: install Node.js 20 or newer, then `make vendor`")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for lock_file in LOCK_FILES:
            shutil.copy(LOCK_DIR / lock_file, folder)
        subprocess.run([npm, "ci", "--ignore-scripts"], cwd=folder, check=True)
        copy_files(folder / "node_modules")


def copy_files(modules: Path) -> None:
    """Replace the vendored files and their manifest by those of installed packages."""
    shutil.rmtree(VENDOR_DIR, ignore_errors=True)
    VENDOR_DIR.mkdir(parents=True)
    manifest = {}
    for package, names in TAKEN.items():
        about = json.loads((modules / package / "package.json").read_text(encoding="utf-8"))
        for source, target in names.items():
            shutil.copyfile(modules / package / source, VENDOR_DIR / target)
        checksums = {target: sha256_hex((VENDOR_DIR / target).read_bytes()) for target in names.values()}
        manifest[package] = {"version": about["version"], "license": about["license"], "sha256": checksums}
        print(f"{package} {about['version']}: {', '.join(names.values())}")
    MANIFEST_FILE.write_text(canonical_json(manifest), encoding="utf-8")


if __name__ == "__main__":
    main()
