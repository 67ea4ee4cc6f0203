"""Official files from the network; what talks to it is in ``fetcher`` and is imported only to fetch."""

from leaderboard.reference.fetching.remotes import Fetched, Remote, RemoteArchive, RemoteFile
from leaderboard.reference.fetching.upstream import SourceChange, compare_sources

__all__ = ["Fetched", "Remote", "RemoteArchive", "RemoteFile", "SourceChange", "compare_sources"]
