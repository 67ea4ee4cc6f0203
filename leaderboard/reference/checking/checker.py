"""Checking a reference: every assumption beside what was found, less what errata accept."""

from dataclasses import dataclass

from leaderboard.instance import Instance
from leaderboard.models import Errata, Manifest
from leaderboard.problems import Problem, Problems, Severity
from leaderboard.reference.checking.balance import check_balance
from leaderboard.reference.checking.corrections import check_corrections
from leaderboard.reference.checking.counts import check_counts
from leaderboard.reference.checking.datasheet import Datasheet, Finding, Section, accept_findings
from leaderboard.reference.checking.design import check_design
from leaderboard.reference.checking.files import SEAL_CODES, check_files, check_published, find_strays
from leaderboard.reference.checking.pairs import check_pairs
from leaderboard.reference.checking.raters import check_raters
from leaderboard.reference.checking.ratings import check_ratings
from leaderboard.reference.data import Reference
from leaderboard.reference.definition import read_manifest
from leaderboard.reference.sealing import check_seal, digest_of
from leaderboard.reference.tables import read_tables

# Stands in for a missing manifest, so that content can be checked before it is sealed.
_UNSEALED = Manifest(kind="official", files={}, digest=digest_of({}))


@dataclass(frozen=True)
class Verdict:
    """What checking found.

    Attributes
    ----------
    problems
        Everything that is wrong or not as expected and that no errata accept. Errors are what
        `leaderboard.reference.load_reference` refuses; warnings depart from the definition; notes are facts
        that a reader of the scores should know.
    reference
        What was checked; None if its files cannot be understood.
    datasheet
        Every assumption; None likewise.
    """

    problems: tuple[Problem, ...]
    reference: Reference | None = None
    datasheet: Datasheet | None = None

    @property
    def is_sound(self) -> bool:
        """Whether there are notes at most."""
        return all(problem.severity is Severity.NOTE for problem in self.problems)

    @property
    def accepted(self) -> tuple[Finding, ...]:
        """The findings that errata accept."""
        return () if self.datasheet is None else self.datasheet.accepted


def check_reference(instance: Instance) -> Verdict:
    """Check all of a reference; where tables cannot be understood, only that is reported."""
    tables, problems = read_tables(instance)
    manifest = read_manifest(instance, problems)
    if tables is None:
        return Verdict(tuple(problems))
    if manifest is not None:
        check_seal(tables.contents, manifest, problems)
    strays = find_strays(instance, tables.benchmark)
    check_published(instance, problems)
    if not tables.is_whole:
        return Verdict((*problems, *strays))
    reference = tables.bind(manifest or _UNSEALED)
    seal = [] if manifest is None else [problem for problem in problems if problem.code in SEAL_CODES]
    others = [problem for problem in problems if problem not in seal]
    files = check_files(reference, manifest, seal, strays)
    datasheet = Datasheet((files, *draw_datasheet(reference).sections))
    return Verdict((*others, *datasheet.problems), reference, datasheet)


def draw_datasheet(reference: Reference) -> Datasheet:
    """Compare the content of a reference that can be used with what is expected of one."""
    sections = _check_content(reference)
    if reference.errata == Errata():
        return Datasheet(sections)
    found = [finding.problem for finding in Datasheet(sections).findings]
    return Datasheet((*accept_findings(sections, reference.errata), check_corrections(reference, found)))


def check_departures(reference: Reference, problems: Problems) -> None:
    """Report where the content of a reference that can be used differs from what is expected of one."""
    problems.found += draw_datasheet(reference).problems


def _check_content(reference: Reference) -> tuple[Section, ...]:
    sections = [check_counts(reference), check_pairs(reference), check_balance(reference)]
    sections.append(check_ratings(reference))
    responses = reference.people.responses if reference.people else None
    if responses is not None:
        sections += [check_raters(responses), check_design(reference, responses)]
    return tuple(sections)
