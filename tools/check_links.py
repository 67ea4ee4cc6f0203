"""Check every link of a built site without network: `python tools/check_links.py site/dist`.

A link within the site is relative, leads to a file that is there and, after `#`, to an id in it; it names
the file itself, because a folder has no page where the site is opened as files. Only links that a reader
follows may lead out. Ids are given once, and what refers to an id of its own page, such as `aria-labelledby`,
finds it.
"""

import sys
from collections import Counter
from collections.abc import Collection, Mapping
from html.parser import HTMLParser
from pathlib import Path
from posixpath import dirname, join, normpath
from urllib.parse import unquote, urlsplit

LINKING = frozenset({"href", "src", "poster", "action", "formaction", "data"})
REFERRING = frozenset({"aria-labelledby", "aria-describedby", "aria-controls", "for", "headers", "list"})
OUTSIDE = frozenset({"http", "https", "mailto"})


class Links(HTMLParser):
    """What a page gives ids to, links to, and refers to on its own."""

    def __init__(self) -> None:
        super().__init__()
        self.ids: Counter[str] = Counter()
        self.targets: set[tuple[str, str]] = set()
        self.references: set[str] = set()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note what the attributes of an element link and name."""
        for name, value in attrs:
            if name == "id":
                self.ids[value or ""] += 1
            elif name in LINKING:
                self.targets.add((tag, value or ""))
            elif name in REFERRING:
                self.references.update((value or "").split())


def read_links(page: bytes) -> Links:
    """Read the links and ids of a page."""
    links = Links()
    links.feed(page.decode())
    links.close()
    return links


def find_faults(files: Mapping[str, bytes]) -> list[str]:
    """Name every link of a site's pages that leads nowhere, and every id that is not given exactly once.

    Parameters
    ----------
    files
        The whole site, path to bytes.
    """
    pages = {path: read_links(content) for path, content in files.items() if path.endswith(".html")}
    places = {path: pages[path].ids.keys() if path in pages else frozenset() for path in files}
    faults = []
    for path, page in sorted(pages.items()):
        twice = sorted(name for name, count in page.ids.items() if count > 1)
        missing = sorted(page.references - page.ids.keys())
        faults += [f"{path}: the id {name!r} is given {page.ids[name]} times" for name in twice]
        faults += [f"{path}: refers to the id {name!r}, which is not on the page" for name in missing]
        for tag, target in sorted(page.targets):
            fault = judge_target(path, tag, target, places)
            faults += [f"{path}: the link {target!r} {fault}"] if fault else []
    return faults


def judge_target(path: str, tag: str, target: str, places: Mapping[str, Collection[str]]) -> str:
    """Say what is wrong with a link of a page; nothing if it is right.

    Parameters
    ----------
    places
        The ids in each file of the site, by its path; none where it is no page.
    """
    parts = urlsplit(target)
    if parts.scheme in OUTSIDE:
        return "" if tag == "a" else "loads something from elsewhere"
    if parts.scheme or parts.netloc or target.startswith("/"):
        return "is not relative"
    file = normpath(join(dirname(path), unquote(parts.path))) if parts.path else path
    if file not in places:
        return "leads to no file"
    place = unquote(parts.fragment)
    return f"leads to no id in {file}" if place and place not in places[file] else ""


def main(folder: Path) -> int:
    """Print all faults of a built site; the exit status tells whether there are any."""
    paths = sorted(path for path in folder.rglob("*") if path.is_file())
    files = {path.relative_to(folder).as_posix(): path.read_bytes() for path in paths}
    faults = find_faults(files)
    n_pages = sum(path.endswith(".html") for path in files)
    print(*faults, f"{len(faults)} faults in {n_pages} pages", sep="\n")
    return 1 if faults or not n_pages else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:  # noqa: PLR2004 - the command and its folder
        sys.exit("usage: python tools/check_links.py FOLDER")
    sys.exit(main(Path(sys.argv[1])))
