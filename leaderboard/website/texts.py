"""What maintainers say on their site: plain paragraphs about it, and how to cite its benchmark."""

from dataclasses import dataclass

from leaderboard.errors import InstanceError
from leaderboard.files import read_regular
from leaderboard.instance import ABOUT_FILE, CITATION_FILE, Instance

MAX_BYTES = 100_000


@dataclass(frozen=True)
class Texts:
    """Paragraphs of plain text, and BibTeX as it was written; empty where there is none."""

    about: tuple[str, ...] = ()
    citation: str = ""


NO_TEXTS = Texts()


def load_texts(instance: Instance) -> Texts:
    """Read the texts of an instance, as far as there are any.

    Raises
    ------
    InstanceError
        If one cannot be read, is too large or is not UTF-8.
    """
    paragraphs = _read_text(instance, ABOUT_FILE).split("\n\n")
    about = (" ".join(paragraph.split()) for paragraph in paragraphs)
    return Texts(tuple(filter(None, about)), _read_text(instance, CITATION_FILE).strip("\n"))


def _read_text(instance: Instance, name: str) -> str:
    file = instance.content_file(name)
    if not file.exists():
        return ""
    location = instance.display_path(file)
    try:
        content = read_regular(file, MAX_BYTES)
        text = None if content is None else content.decode()
    except (OSError, UnicodeDecodeError) as error:
        raise InstanceError(f"{location} cannot be read", "make it a plain file of UTF-8 text") from error
    if text is None:
        raise InstanceError(f"{location} is too large", f"keep it below {MAX_BYTES:,} bytes")
    return text.replace("\r\n", "\n")
