"""The page of the public record: what was graded with what, what is in doubt, and what was ever published."""

from collections.abc import Iterator
from dataclasses import dataclass

from leaderboard import __version__
from leaderboard.grading import METRICS_VERSION
from leaderboard.models.ledger import LedgerLine
from leaderboard.website.describing import count_of, submission_path
from leaderboard.website.material import Material
from leaderboard.website.pages import Fact, Link, Page

N_HASH_DIGITS = 12
NOTHING_FAILED = (
    "None. A result that is missing, or that belongs to another file or reference, stops the build before "
    "anything of the site is replaced."
)


@dataclass(frozen=True)
class Doubt:
    """A submission whose checks found something."""

    submission: Link
    findings: tuple[str, ...]


@dataclass(frozen=True)
class RecordLine:
    """What happened to a submission; its target is empty where it has left the board."""

    date: str
    submission: Link
    event: str
    reason: str
    result: str


@dataclass(frozen=True)
class StatusPage(Page):
    """What was graded, what is in doubt, and the public record, newest first."""

    facts: tuple[Fact, ...]
    doubts: tuple[Doubt, ...]
    record: tuple[RecordLine, ...]


def compose_status(material: Material) -> StatusPage:
    """Gather what the page shows."""
    return StatusPage(
        path="status.html",
        title="Status",
        summary="What was graded, with what, and everything that ever happened to a submission.",
        facts=tuple(_list_facts(material)),
        doubts=tuple(_list_doubts(material)),
        record=tuple(_list_record(material)),
    )


def _list_facts(material: Material) -> Iterator[Fact]:
    entries = [publication.entry for publication in material.publications]
    n_baselines = sum(entry.is_baseline for entry in entries)
    n_partial = sum(not entry.is_complete for entry in entries)
    found = f"{count_of(len(entries) - n_baselines, 'submission')} and {count_of(n_baselines, 'baseline')}"
    yield Fact("Graded", f"{found}, {n_partial:,} of them in part")
    manifest = material.reference.manifest
    yield Fact("Against", f"the {manifest.kind} reference {manifest.digest[:N_HASH_DIGITS]}")
    yield Fact("With", f"grader {__version__}, metrics version {METRICS_VERSION}")
    yield Fact("Failed gradings", NOTHING_FAILED)
    newest = material.record[-1].date.isoformat() if material.record else "nothing so far"
    yield Fact("Last event", newest)
    yield Fact("Grade everything again", "leaderboard verify", is_code=True)


def _list_doubts(material: Material) -> Iterator[Doubt]:
    """List what checks found; baselines are what they warn of, on purpose."""
    for entry in (publication.entry for publication in material.publications):
        if entry.result.checks and not entry.is_baseline:
            link = Link(entry.metadata.submission.name, submission_path(entry.slug))
            yield Doubt(link, tuple(check.message for check in entry.result.checks))


def _list_record(material: Material) -> Iterator[RecordLine]:
    published = {publication.entry.slug for publication in material.publications}
    for line in reversed(material.record):
        yield _describe(line, is_published=line.slug in published)


def _describe(line: LedgerLine, *, is_published: bool) -> RecordLine:
    return RecordLine(
        date=line.date.isoformat(),
        submission=Link(line.slug, submission_path(line.slug) if is_published else ""),
        event=line.event,
        reason=line.reason,
        result=line.result_sha256[:N_HASH_DIGITS],
    )
