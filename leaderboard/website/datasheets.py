"""The page of the data: what is kept and why, where it comes from, and every assumption with its finding."""

from leaderboard.models import Source
from leaderboard.reference import Reference
from leaderboard.reference.checking import Finding, Section, draw_datasheet
from leaderboard.website.data_pages import DataPage, FindingRow, Sheet, SheetRow, SourceRow
from leaderboard.website.describing import count_of, describe_people
from leaderboard.website.material import Material
from leaderboard.website.numbers import ABSENT
from leaderboard.website.pages import Fact

MAX_FINDINGS = 200

TRIALS = (
    "of each, its id, its pair, its scenario, which copy it is, how it ends, and the frame at which the "
    "prediction starts. Videos are not kept."
)
RESPONSES = (
    "Of each response three columns are kept: participant, trial and answer. No times, no facts about a "
    "person, and no ids of a recruiting service are kept."
)
PARTICIPANTS = (
    "They are named p and a number, which says nothing about them; another name is a finding below."
)
COUNTS = "Counts alone are kept: how many people judged each trial, and how many of them said YES."
WHY_RESPONSES = (
    "Submissions are compared with people. Single answers tell how well people agree with each other, which "
    "limits how well a model can agree with them, and whether a model errs where a person errs."
)
WHY_COUNTS = "Submissions are compared with the share of people who said YES to each trial."
SIMULATED = "Trials, labels and people are simulated: there is no person behind any answer."


def compose_data(material: Material) -> DataPage:
    """Gather what the page of the data shows."""
    reference = material.reference
    datasheet = draw_datasheet(reference)
    found = [finding for finding in datasheet.findings if finding.is_open]
    return DataPage(
        path="data.html",
        title="Data",
        summary="What submissions are graded against: what is kept, why, where it comes from, its oddities.",
        about=_describe_data(material),
        sources=tuple(_describe_source(source) for source in reference.manifest.sources),
        no_sources=SIMULATED if reference.is_synthetic else "The manifest names no official file.",
        files=_list_files(reference),
        sheets=tuple(_show_section(key, section) for key, section in enumerate(datasheet.sections, 1)),
        findings=tuple(_show_finding(finding) for finding in found[:MAX_FINDINGS]),
        n_unlisted=max(len(found) - MAX_FINDINGS, 0),
        accepted=tuple(_show_finding(finding) for finding in datasheet.accepted),
        dropped=tuple(Fact(trial_id, reason) for trial_id, reason in reference.dropped.items()),
    )


def _describe_data(material: Material) -> tuple[Fact, ...]:
    reference = material.reference
    facts = [
        Fact("Trials", f"{count_of(reference.n_trials, 'trial')}; {TRIALS}"),
        *_describe_humans(material),
    ]
    return (*facts, Fact("Licence", _describe_licence(reference)))


def _describe_humans(material: Material) -> list[Fact]:
    people = material.reference.people
    if people is None:
        return [Fact("People", "There are no human data.")]
    counted = describe_people(material)
    if people.responses is None:
        return [Fact("People", f"{counted}. {COUNTS}"), Fact("Why", WHY_COUNTS)]
    return [
        Fact("People", f"{counted}. {RESPONSES}"),
        Fact("Participants", PARTICIPANTS),
        Fact("Why", WHY_RESPONSES),
    ]


def _describe_licence(reference: Reference) -> str:
    licence = reference.benchmark.licence
    official = f"The official files are under the licence {licence}." if licence else ""
    if reference.is_synthetic:
        return f"{SIMULATED} {official}".strip()
    return official or "The definition names no licence of the official files."


def _describe_source(source: Source) -> SourceRow:
    is_web = source.url.startswith(("https://", "http://"))
    return SourceRow(
        what=source.what,
        url=source.url,
        target=source.url if is_web else "",
        member=source.member,
        sha256=source.sha256 or ABSENT,
        modified=source.last_modified or ABSENT,
    )


def _list_files(reference: Reference) -> tuple[Fact, ...]:
    manifest = reference.manifest
    files = [Fact(name, manifest.files[name], is_code=True) for name in sorted(manifest.files)]
    return (*files, Fact("All together", manifest.digest, is_code=True))


def _show_section(key: int, section: Section) -> Sheet:
    rows = (
        SheetRow(row.assumption, row.expected or ABSENT, row.found, row.status.value, row.code)
        for row in section.rows
    )
    return Sheet(f"sheet-{key}", section.title, tuple(rows), section.note)


def _show_finding(finding: Finding) -> FindingRow:
    problem = finding.problem
    place = problem.file if problem.line is None else f"{problem.file}, line {problem.line}"
    return FindingRow(problem.code, problem.message, place, finding.reason)
