"""Official files from the network, each with where it came from."""

from collections.abc import Sequence
from pathlib import Path
from urllib.parse import unquote, urlsplit

from leaderboard.errors import SourceError
from leaderboard.models import Source
from leaderboard.reference.fetching.cache import Cache, open_cache
from leaderboard.reference.fetching.downloads import Download
from leaderboard.reference.fetching.failures import show_url, strip_credentials
from leaderboard.reference.fetching.progress import SILENT, Progress
from leaderboard.reference.fetching.remote_archives import fetch_members
from leaderboard.reference.fetching.remotes import Fetched, Remote, RemoteArchive, RemoteFile
from leaderboard.reference.fetching.sessions import PATIENCE, Connection, Patience
from leaderboard.reference.fetching.upstream import Upstream
from leaderboard.reference.source_archives import LIMITS, open_archive
from leaderboard.reference.source_files import SourceFile, read_members

SMALL_ARCHIVE = 2_000_000_000  # bytes that an archive which is not large may have
LARGE_ARCHIVE = 200_000_000_000

Taken = tuple[tuple[SourceFile, ...], Upstream]


def fetch_source_files(
    remotes: Sequence[Remote],
    *,
    full_download: bool = False,
    progress: Progress = SILENT,
    cache: Path | None = None,
    patience: Patience = PATIENCE,
) -> Fetched:
    """Fetch official files.

    Parameters
    ----------
    remotes
        What to fetch, one after the other.
    full_download
        Whether to take large archives whole.
    progress
        Is told how far the transfers are.
    cache
        The folder for what is taken whole; by default the user's.
    patience
        How long to wait and how often to try again.

    Raises
    ------
    SourceError
        If a file cannot be fetched, or is not what it should be.
    InstanceError
        If the cache cannot be used.
    """
    files: list[SourceFile] = []
    sources: list[Source] = []
    with open_cache(cache) as opened, Connection(patience, progress) as connection:
        for remote in remotes:
            taken, upstream = _fetch_remote(remote, opened, connection, full_download=full_download)
            files += taken
            sources += [_make_source(remote, file, upstream) for file in taken]
    return Fetched(tuple(files), tuple(sources), connection.n_bytes)


def _fetch_remote(remote: Remote, cache: Cache, connection: Connection, *, full_download: bool) -> Taken:
    if isinstance(remote, RemoteFile):
        return _fetch_file(remote, cache, connection)
    if remote.is_large and not full_download:
        _refuse_checksum(remote)
        return fetch_members(connection, remote)
    return _fetch_archive(remote, cache, connection)


def _fetch_file(remote: RemoteFile, cache: Cache, connection: Connection) -> Taken:
    download = Download(remote.what, remote.url, cache.place(remote.url), LIMITS.file_size)
    upstream = download.fetch(connection, remote.sha256)
    name = unquote(urlsplit(remote.url).path).rpartition("/")[2]
    content = download.place.whole_file.read_bytes()
    return (SourceFile(name, show_url(remote.url), content),), upstream


def _fetch_archive(remote: RemoteArchive, cache: Cache, connection: Connection) -> Taken:
    limit = LARGE_ARCHIVE if remote.is_large else SMALL_ARCHIVE
    download = Download(remote.what, remote.url, cache.place(remote.url), limit)
    upstream = download.fetch(connection, remote.sha256)
    origin = show_url(remote.url)
    with download.place.whole_file.open("rb", buffering=0) as stream, open_archive(stream, origin) as archive:
        return read_members(archive, origin, remote.is_wanted), upstream


def _refuse_checksum(remote: RemoteArchive) -> None:
    if remote.sha256:
        message = f"{show_url(remote.url)}: has a checksum, which parts of it cannot prove"
        raise SourceError(message, "take it whole with --full-download, or leave its sha256 empty")


def _make_source(remote: Remote, file: SourceFile, upstream: Upstream) -> Source:
    return Source(
        what=remote.what,
        url=strip_credentials(remote.url),
        member=file.name if isinstance(remote, RemoteArchive) else "",
        sha256=file.sha256,
        etag=upstream.etag,
        last_modified=upstream.last_modified,
    )
