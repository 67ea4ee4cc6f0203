"""The reference's seal: one checksum for each file, and one digest over them all."""

from collections.abc import Mapping, Sequence

from leaderboard.errors import BrokenReferenceError
from leaderboard.files import canonical_json, sha256_hex, write_atomic
from leaderboard.instance import MANIFEST_FILE, Instance
from leaderboard.models import Manifest, Source
from leaderboard.models.benchmark import ReferenceKind
from leaderboard.problems import Problems
from leaderboard.reference.definition import CHECK_HINT, SEAL_HINT, read_manifest, shown
from leaderboard.reference.tables import read_tables


def digest_of(checksums: Mapping[str, str]) -> str:
    """Return the one SHA-256 that identifies a reference.

    It is that of the text of the sorted lines ``<sha256>  <name>``, each ended by LF: what
    ``sha256sum FILES | LC_ALL=C sort | sha256sum`` prints.

    Parameters
    ----------
    checksums
        SHA-256 of each file, by name.

    Examples
    --------
    >>> digest_of({})[:8]
    'e3b0c442'
    """
    lines = sorted(f"{checksum}  {name}\n" for name, checksum in checksums.items())
    return sha256_hex("".join(lines).encode())


def check_seal(contents: Mapping[str, bytes], manifest: Manifest, problems: Problems) -> None:
    """Report every file that is not the one that was sealed, and a digest that is not that of the files.

    A file that could not be read has its problem already and gets no second one.
    """
    unread = {problem.file for problem in problems} - {shown(name) for name in contents}
    for name in sorted(contents.keys() | manifest.files.keys()):
        message = _say_unsealed(contents.get(name), manifest.files.get(name))
        if message and shown(name) not in unread:
            problems.add("reference-seal", message, shown(name), hint=SEAL_HINT)
    if manifest.digest != digest_of(manifest.files):
        message = "its digest is not that of the checksums that it lists"
        problems.add("reference-manifest", message, shown(MANIFEST_FILE), hint=SEAL_HINT)


def seal_reference(
    instance: Instance, kind: ReferenceKind, *, sources: Sequence[Source] | None = None
) -> Manifest:
    """Write ``manifest.json`` for the files as they are.

    Parameters
    ----------
    instance
        Whose reference.
    kind
        Whether trials and people are real.
    sources
        Where the files came from. By default those of the present manifest are kept if it has the same kind.

    Raises
    ------
    BrokenReferenceError
        If the files could not be used for grading all the same.
    """
    tables, problems = read_tables(instance)
    if tables is None or problems.has_errors:
        raise broken_reference(problems)
    checksums = {name: sha256_hex(tables.contents[name]) for name in sorted(tables.contents)}
    manifest = Manifest(
        kind=kind,
        sources=_present_sources(instance, kind) if sources is None else tuple(sources),
        files=checksums,
        digest=digest_of(checksums),
    )
    content = canonical_json(manifest.model_dump(mode="json", exclude_defaults=True))
    write_atomic(instance.manifest_file, content.encode())
    return manifest


def broken_reference(problems: Problems) -> BrokenReferenceError:
    """Make the exception that names the first problem and counts the others."""
    first, *others = problems.found
    line = "" if first.line is None else f":{first.line}"
    rest = f" (and {len(others)} more problem{'s' if len(others) > 1 else ''})" if others else ""
    hint = f"{first.hint}; all problems: {CHECK_HINT}" if first.hint else f"all problems: {CHECK_HINT}"
    return BrokenReferenceError(f"{first.file}{line}: {first.message}{rest}", hint)


def _say_unsealed(content: bytes | None, checksum: str | None) -> str:
    if checksum is None:
        return f"is not listed in {MANIFEST_FILE}"
    if content is None:
        return f"is listed in {MANIFEST_FILE}, but is not there"
    return "" if sha256_hex(content) == checksum else f"differs from {MANIFEST_FILE}: its checksum is another"


def _present_sources(instance: Instance, kind: ReferenceKind) -> tuple[Source, ...]:
    present = read_manifest(instance, Problems())
    return present.sources if present is not None and present.kind == kind else ()
