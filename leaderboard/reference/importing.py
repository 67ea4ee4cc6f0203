"""From official files to a sealed reference: judged, compared with what is there, and only then written."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import tomli_w

from leaderboard.errors import BrokenReferenceError, InstanceError
from leaderboard.files import sha256_hex
from leaderboard.instance import ERRATA_FILE, PUBLISHED_FILE, Instance
from leaderboard.models import Benchmark, Manifest, Source
from leaderboard.problems import Problem, Problems
from leaderboard.reference.checking import check_departures
from leaderboard.reference.data import Reference
from leaderboard.reference.definition import parse_benchmark, parse_errata, read_benchmark, read_manifest
from leaderboard.reference.differences import Difference, compare_references
from leaderboard.reference.fetching import Remote, SourceChange, compare_sources
from leaderboard.reference.fetching.progress import SILENT, Progress
from leaderboard.reference.installing import install_reference
from leaderboard.reference.loading import load_reference
from leaderboard.reference.recipes.recipe import ImportedProperty, ImportOptions, Recipe
from leaderboard.reference.sealing import broken_reference, digest_of
from leaderboard.reference.source_files import SourceFile
from leaderboard.reference.tables import parse_tables

KEPT_FILES = (PUBLISHED_FILE, ERRATA_FILE)  # an import neither makes nor loses them


@dataclass(frozen=True)
class ImportReport:
    """What an import made, and every oddity of the official files that it met.

    Attributes
    ----------
    title, root
        The benchmark's, and where its reference is.
    manifest
        The seal of what was written; None if nothing was.
    properties
        What was imported, by property; empty if the files could not be understood.
    problems
        Those of the official files, then those of the reference made from them.
    difference
        From the official reference that was there; None if there was none.
    source_changes
        What has changed upstream since the official files were last fetched.
    """

    title: str
    root: Path
    manifest: Manifest | None
    properties: tuple[ImportedProperty, ...]
    problems: tuple[Problem, ...]
    difference: Difference | None = None
    source_changes: tuple[SourceChange, ...] = ()

    @property
    def is_changed(self) -> bool:
        """Whether the official reference, or the official files behind it, are not what they were."""
        return bool(self.difference) or any(change.is_content for change in self.source_changes)

    @property
    def is_refused(self) -> bool:
        """Whether nothing was written although something would have changed."""
        return self.manifest is None and (self.difference is None or self.is_changed)


@dataclass(frozen=True)
class FetchOptions:
    """How to fetch.

    Attributes
    ----------
    mirror
        Where to take the files from instead of their official addresses: a URL below which they lie by name.
    full_download
        Whether to take large archives whole.
    cache
        The folder for what is taken whole; by default the user's.
    progress
        Is told how far the transfers are.
    """

    mirror: str = ""
    full_download: bool = False
    cache: Path | None = None
    progress: Progress = SILENT


def fetch_reference(
    recipe: Recipe,
    instance: Instance,
    *,
    how: FetchOptions | None = None,
    options: ImportOptions | None = None,
    accept_change: bool = False,
) -> ImportReport:
    """Fetch a benchmark's official files and make the reference from them, as `import_reference` does.

    Raises
    ------
    SourceError
        If a file cannot be fetched, or is missing or malformed.
    InstanceError
        If the instance is another benchmark's.
    """
    from leaderboard.reference.fetching.fetcher import fetch_source_files  # start-up: only what fetches pays

    how = how or FetchOptions()
    benchmark = parse_benchmark(_choose_definition(recipe, instance), problems := Problems())
    if benchmark is None:
        raise broken_reference(problems)
    remotes = [_redirect(remote, how.mirror) for remote in recipe.list_remotes(benchmark)]
    fetched = fetch_source_files(
        remotes, full_download=how.full_download, progress=how.progress, cache=how.cache
    )
    return import_reference(
        recipe,
        fetched.files,
        instance,
        options=options,
        fetched=fetched.sources,
        accept_change=accept_change,
    )


def import_reference(
    recipe: Recipe,
    files: Sequence[SourceFile],
    instance: Instance,
    *,
    options: ImportOptions | None = None,
    fetched: Sequence[Source] = (),
    accept_change: bool = False,
) -> ImportReport:
    """Make a reference from official files and put it in place of a simulated or an older one.

    Nothing is written if a file cannot be understood, if nothing would change, or if an official reference
    would change and that is not accepted.

    Parameters
    ----------
    recipe
        How to read the files.
    files
        The official files.
    instance
        Where; it may be new.
    options
        What the files leave open.
    fetched
        Where the files came from, if they were fetched.
    accept_change
        Whether an official reference that is there may be replaced by a different one.

    Raises
    ------
    SourceError
        If a file is missing or malformed.
    InstanceError
        If the instance is another benchmark's.
    """
    problems = Problems()
    definition = _choose_definition(recipe, instance)
    draft = recipe.draft(files, definition, options or ImportOptions(), problems)
    if draft is None or problems.has_errors:
        return ImportReport(recipe.title, instance.root, None, (), tuple(problems))
    contents = {**_read_kept(instance), **draft.contents}
    contents = _add_errata(contents, draft.dropped, problems)
    reference = _preview(contents, parse_benchmark(definition, problems), problems)
    check_departures(reference, problems)
    older = _load_official(instance, accept_change=accept_change)
    sources = _locate(draft.sources, fetched)
    report = ImportReport(
        title=recipe.title,
        root=instance.root,
        manifest=None,
        properties=draft.properties,
        problems=tuple(problems),
        difference=None if older is None else compare_references(older, reference, contents),
        source_changes=_compare_sources(older, sources) if older and fetched else (),
    )
    if report.difference is None or (report.is_changed and accept_change):
        manifest = install_reference(instance, contents, "official", sources=sources)
        return replace(report, manifest=manifest)
    return report


def _choose_definition(recipe: Recipe, instance: Instance) -> bytes:
    """Take the instance's own definition; the recipe's if it has none."""
    if not instance.benchmark_file.exists():
        return recipe.render_definition()
    problems = Problems()
    found = read_benchmark(instance, problems)
    if found is None:
        raise broken_reference(problems)
    content, benchmark = found
    if benchmark.name != recipe.name:
        raise InstanceError(
            f"{instance.reference_dir} is of {benchmark.title}, not of {recipe.title}",
            "name a new folder with --root DIR",
        )
    return content


def _redirect(remote: Remote, mirror: str) -> Remote:
    """Take a file of the same name from a mirror, if there is one."""
    return replace(remote, url=f"{mirror.rstrip('/')}/{_name_of(remote.url)}") if mirror else remote


def _name_of(url: str) -> str:
    return url.rstrip("/").rpartition("/")[2]


def _locate(sources: Sequence[Source], fetched: Sequence[Source]) -> tuple[Source, ...]:
    """Say of what a recipe read where it was fetched, and which version that was."""
    places = {place.what: place for place in reversed(fetched)}
    return tuple(
        source.model_copy(update=places[source.what].model_dump(include={"url", "etag", "last_modified"}))
        if source.what in places
        else source
        for source in sources
    )


def _compare_sources(older: Reference, found: Sequence[Source]) -> tuple[SourceChange, ...]:
    """Compare what was fetched with what was fetched before, wherever from."""
    locked = older.manifest.sources
    return compare_sources(*([_name_source(source) for source in sources] for sources in (locked, found)))


def _name_source(source: Source) -> Source:
    return source.model_copy(update={"url": _name_of(source.url), "member": _name_of(source.member)})


def _read_kept(instance: Instance) -> dict[str, bytes]:
    files = {name: instance.reference_file(name) for name in KEPT_FILES}
    return {name: file.read_bytes() for name, file in files.items() if file.is_file()}


def _add_errata(
    contents: Mapping[str, bytes], dropped: Mapping[str, str], problems: Problems
) -> dict[str, bytes]:
    """Add errata for trials that cannot be graded, beside those that a maintainer wrote."""
    written = contents.get(ERRATA_FILE, b"")
    errata = parse_errata(written, problems)
    if errata is None:
        raise broken_reference(problems)
    new = [{"trial_id": t, "reason": dropped[t]} for t in sorted(dropped.keys() - errata.reasons.keys())]
    if not new:
        return dict(contents)
    tables = [f"[[drop]]\n{tomli_w.dumps(drop)}" for drop in new]
    return {**contents, ERRATA_FILE: "\n".join([*filter(None, [written.decode()]), *tables]).encode()}


def _preview(contents: Mapping[str, bytes], benchmark: Benchmark | None, problems: Problems) -> Reference:
    """Read what is going to be written as a grader will."""
    tables = None if benchmark is None else parse_tables(benchmark, contents, problems)
    if tables is None or not tables.is_whole:
        raise broken_reference(problems)
    checksums = {name: sha256_hex(content) for name, content in contents.items()}
    return tables.bind(Manifest(kind="official", files=checksums, digest=digest_of(checksums)))


def _load_official(instance: Instance, *, accept_change: bool) -> Reference | None:
    """Load the official reference that is there; a broken one counts as none where any change is accepted."""
    manifest = read_manifest(instance, Problems())
    if manifest is None or manifest.kind != "official":
        return None
    try:
        return load_reference(instance)
    except BrokenReferenceError:
        if accept_change:
            return None
        raise
