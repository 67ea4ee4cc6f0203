"""The website: boards and submissions as plain files that read without JavaScript and work from anywhere."""

from leaderboard.website.building import SiteReport, build_site
from leaderboard.website.serving import open_server, serve_site

__all__ = ["SiteReport", "build_site", "open_server", "serve_site"]
