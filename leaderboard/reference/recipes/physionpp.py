"""The recipe for Physion++: lists of test trials and people's answers, in whatever dialect they come."""

from collections.abc import Mapping, Sequence
from importlib.resources import files as package_files

from leaderboard.errors import SourceError
from leaderboard.files import csv_text, sha256_hex
from leaderboard.instance import BENCHMARK_FILE, HUMAN_RESPONSES_FILE, HUMAN_TRIALS_FILE
from leaderboard.models import Benchmark, Source
from leaderboard.problems import Problems
from leaderboard.reference.definition import parse_benchmark
from leaderboard.reference.fetching import Remote, RemoteArchive
from leaderboard.reference.judgements import JudgementOptions, Judgements, Rating, parse_judgements
from leaderboard.reference.people import RATING_HEADER, RESPONSE_HEADER
from leaderboard.reference.recipes.physionpp_lists import (
    ListedTrial,
    is_other_split,
    is_trial_list,
    parse_trial_lists,
)
from leaderboard.reference.recipes.recipe import Draft, ImportedProperty, ImportOptions
from leaderboard.reference.source_files import SourceFile
from leaderboard.reference.source_tables import SourceTable, parse_source_table
from leaderboard.reference.tables import TRIAL_HEADER

CONTESTED = "The official lists give this trial both labels."
N_ARCHIVES = 2  # the definition's sources: test trials, then human data
ALL_MEMBERS = "*"


def render_physionpp_definition() -> bytes:
    """Return the content of ``benchmark.toml``."""
    return package_files("leaderboard.reference.recipes").joinpath("physionpp.toml").read_bytes()


def is_physionpp_file(name: str) -> bool:
    """Tell whether a file may be a list of trials or hold human data: both are CSV."""
    return name.lower().endswith(".csv")


def list_physionpp_remotes(benchmark: Benchmark) -> tuple[Remote, ...]:
    """List the two archives: of test trials, gigabytes of which only the lists are read, and of human data.

    Raises
    ------
    SourceError
        If the definition does not name both.
    """
    if len(benchmark.sources) != N_ARCHIVES:
        message = f"benchmark.toml names {len(benchmark.sources)} sources; it must name {N_ARCHIVES}"
        raise SourceError(message, "first the archive of test trials, then that of human data")
    trials, humans = benchmark.sources
    return (
        RemoteArchive(trials.what, trials.url, is_physionpp_file, is_large=True, sha256=trials.sha256),
        RemoteArchive(humans.what, humans.url, is_physionpp_file, is_large=False, sha256=humans.sha256),
    )


def draft_physionpp(
    files: Sequence[SourceFile], definition: bytes, options: ImportOptions, problems: Problems
) -> Draft | None:
    """Make a reference of Physion++ from its official files, whatever their names and dialects.

    Parameters
    ----------
    files
        All CSV files of the release; what they are is told from their columns.
    definition
        The content of ``benchmark.toml``.
    options
        Which columns hold human data, and whether unmatched answers are left out.
    problems
        Receives every oddity.

    Returns
    -------
    Draft or None
        None if a problem is an error.

    Raises
    ------
    SourceError
        If a file is malformed.
    """
    benchmark = parse_benchmark(definition, problems)
    if benchmark is None:
        return None
    lists, others = _sort_files(files, problems)
    trials, contested = parse_trial_lists([table for _, table in lists], benchmark, problems)
    _require_trials(trials, files, problems)
    judgements = None if problems.has_errors else _parse_people(others, trials, options, problems)
    if problems.has_errors:
        return None
    contents = {BENCHMARK_FILE: definition} | _render(trials, judgements, benchmark)
    properties = tuple(_summarize(p.name, benchmark, trials, judgements) for p in benchmark.properties)
    sources = _list_sources(benchmark, [file for file, _ in lists], others)
    return Draft(contents, properties, sources, dict.fromkeys(sorted(contested), CONTESTED))


def _sort_files(
    files: Sequence[SourceFile], problems: Problems
) -> tuple[list[tuple[SourceFile, SourceTable]], list[SourceFile]]:
    """Tell lists of test trials from everything else; lists for other purposes are set aside."""
    lists, others = [], []
    for file in files:
        table = parse_source_table(file)
        if not is_trial_list(table):
            others.append(file)
        elif is_other_split(file.name, table):
            message = f"lists {len(table.rows)} trials for training or for fitting readouts; it is not used"
            problems.add("import-other-split", message, file.origin)
        else:
            lists.append((file, table))
    return lists, others


def _require_trials(
    trials: Mapping[str, ListedTrial], files: Sequence[SourceFile], problems: Problems
) -> None:
    if not trials:
        names = ", ".join(file.name for file in files[:3]) or "no CSV file at all"
        message = f"no file lists test trials: a path of a video and a label in each row; found {names}"
        problems.add("import-no-trials", message, files[0].origin if files else "--from")


def _parse_people(
    files: Sequence[SourceFile],
    trials: Mapping[str, ListedTrial],
    options: ImportOptions,
    problems: Problems,
) -> Judgements | None:
    if not files:
        problems.add("import-no-people", "there are no files of human data", HUMAN_TRIALS_FILE)
        return None
    labels = {trial_id: trial.is_yes for trial_id, trial in trials.items()}
    wanted = JudgementOptions(columns=options.columns, allow_unmatched=options.allow_unmatched)
    return parse_judgements(files, labels, wanted, problems)


def _render(
    trials: Mapping[str, ListedTrial], judgements: Judgements | None, benchmark: Benchmark
) -> dict[str, bytes]:
    """Write trials by property, and human data, as the reference's files."""
    property_of = {scenario.id: scenario.property for scenario in benchmark.scenarios}
    tables = {
        property_.file: csv_text(
            TRIAL_HEADER,
            [
                _render_trial(trial_id, trial)
                for trial_id, trial in trials.items()
                if property_of[trial.name.scenario] == property_.name
            ],
        )
        for property_ in benchmark.properties
    }
    if judgements is not None:
        ratings = [(trial_id, r.n, r.n_yes) for trial_id, r in judgements.ratings.items()]
        tables[HUMAN_TRIALS_FILE] = csv_text(RATING_HEADER, ratings)
        if judgements.responses is not None:
            responses = [(r.participant_id, r.trial_id, int(r.is_yes)) for r in judgements.responses]
            tables[HUMAN_RESPONSES_FILE] = csv_text(RESPONSE_HEADER, responses)
    return {name: table.encode() for name, table in tables.items()}


def _render_trial(trial_id: str, trial: ListedTrial) -> tuple[object, ...]:
    name = trial.name
    start_frame = "" if trial.start_frame is None else trial.start_frame
    return (trial_id, name.pair_id, name.scenario, name.copy, int(trial.is_yes), start_frame)


def _summarize(
    property_name: str,
    benchmark: Benchmark,
    trials: Mapping[str, ListedTrial],
    judgements: Judgements | None,
) -> ImportedProperty:
    scenarios = {scenario.id for scenario in benchmark.scenarios_of(property_name)}
    own = [trial_id for trial_id, trial in trials.items() if trial.name.scenario in scenarios]
    ratings = {} if judgements is None else {t: judgements.ratings[t] for t in own if t in judgements.ratings}
    shares = [_share_right(rating, trials[trial_id].is_yes) for trial_id, rating in ratings.items()]
    return ImportedProperty(
        property_name, len(own), len(shares), sum(shares) / len(shares) if shares else None
    )


def _share_right(rating: Rating, is_yes: bool) -> float:  # noqa: FBT001  (the label)
    return (rating.n_yes if is_yes else rating.n - rating.n_yes) / rating.n


def _list_sources(
    benchmark: Benchmark, lists: Sequence[SourceFile], people: Sequence[SourceFile]
) -> tuple[Source, ...]:
    """Record what was read under the archives that the definition names.

    Lists are recorded by name, files of human data together: their names may be people's ids.
    """
    if len(benchmark.sources) < N_ARCHIVES:
        return ()
    trials, humans = benchmark.sources[:N_ARCHIVES]
    sources = [
        Source(what=trials.what, url=trials.url, member=file.name, sha256=file.sha256) for file in lists
    ]
    if people:
        checksum = sha256_hex("\n".join(sorted(file.sha256 for file in people)).encode())
        sources.append(Source(what=humans.what, url=humans.url, member=ALL_MEMBERS, sha256=checksum))
    return tuple(sources)
