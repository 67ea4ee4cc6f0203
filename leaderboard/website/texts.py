"""What maintainers say on their site: its title, address and logo, plain paragraphs, and how to cite it."""

import os
import tomllib
from dataclasses import dataclass
from pathlib import Path

from pydantic import ValidationError

from leaderboard.errors import InstanceError
from leaderboard.files import read_regular
from leaderboard.instance import ABOUT_FILE, CITATION_FILE, Instance
from leaderboard.models.faults import describe_faults
from leaderboard.models.site import SiteSettings

MAX_BYTES = 100_000


@dataclass(frozen=True)
class Logo:
    """A picture beside the title: the name of its file, and its bytes."""

    name: str
    content: bytes


@dataclass(frozen=True)
class Texts:
    """Paragraphs of plain text, BibTeX as it was written, and settings; empty where there are none."""

    about: tuple[str, ...] = ()
    citation: str = ""
    title: str = ""
    url: str = ""
    logo: Logo | None = None


NO_TEXTS = Texts()


def load_texts(instance: Instance) -> Texts:
    """Read the texts and settings of an instance, as far as there are any.

    Raises
    ------
    InstanceError
        If one cannot be read, is too large, is not UTF-8, or is not what it should be.
    """
    paragraphs = _read_text(instance, instance.content_file(ABOUT_FILE)).split("\n\n")
    about = (" ".join(paragraph.split()) for paragraph in paragraphs)
    settings = _load_settings(instance)
    return Texts(
        about=tuple(filter(None, about)),
        citation=_read_text(instance, instance.content_file(CITATION_FILE)).strip("\n"),
        title=settings.title or "",
        url=settings.url or "",
        logo=_load_logo(instance, settings.logo) if settings.logo else None,
    )


def _load_settings(instance: Instance) -> SiteSettings:
    location = instance.display_path(instance.site_file)
    hint = "docs/maintaining.md says what it may hold"
    try:
        values = tomllib.loads(_read_text(instance, instance.site_file))
        return SiteSettings.model_validate(values)
    except ValidationError as error:
        raise InstanceError(f"{location}: {'; '.join(describe_faults(error))}", hint) from error
    except ValueError as error:
        raise InstanceError(f"{location} is not TOML: {error}", hint) from error
    except RecursionError as error:
        raise InstanceError(f"{location} is nested too deeply", hint) from error


def _load_logo(instance: Instance, name: str) -> Logo:
    file = instance.content_file(name)
    content = _read(instance, file, "a picture")
    if content is None:
        raise InstanceError(
            f"{instance.display_path(file)} is not there", "the logo of site.toml is this file"
        )
    return Logo(name, content)


def _read_text(instance: Instance, file: Path) -> str:
    content = _read(instance, file, "UTF-8 text")
    try:
        return "" if content is None else content.decode().replace("\r\n", "\n")
    except UnicodeDecodeError as error:
        raise _unreadable(instance, file, "UTF-8 text") from error


def _read(instance: Instance, file: Path, kind: str) -> bytes | None:
    """Read a file of the maintainers; None where there is none."""
    if not os.path.lexists(file):
        return None
    try:
        content = read_regular(file, MAX_BYTES)
    except OSError as error:
        raise _unreadable(instance, file, kind) from error
    if content is None:
        hint = f"keep it below {MAX_BYTES:,} bytes"
        raise InstanceError(f"{instance.display_path(file)} is too large", hint)
    return content


def _unreadable(instance: Instance, file: Path, kind: str) -> InstanceError:
    return InstanceError(f"{instance.display_path(file)} cannot be read", f"make it a plain file of {kind}")
