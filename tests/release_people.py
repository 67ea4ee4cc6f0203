"""People's files: the rows behind them, with whatever is odd about single rows."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from release_traps import Layout, Trap
from release_trials import Answer, Sitting, Trial, stream

N_PRACTICE = 4
SPELLINGS = (("YES", "NO"), ("yes", "no"), ("Yes", "No"), ("1", "0"), ("True", "False"))

# Which people a trap befalls, by the remainder of their number; each in their second answer.
_BEFALLS = {
    Trap.EMPTY_RESPONSES: 0,
    Trap.CONTRADICTED_RESPONSES: 1,
    Trap.DUPLICATE_ANSWERS: 2,
    Trap.UNKNOWN_TRIALS: 4,
}
_CHANGED, _DISAGREEING = 3, 5


@dataclass(frozen=True)
class Row:
    """One answer as people's files tell it.

    ``response`` is empty where it was lost, ``is_right`` None where nobody can tell; ``label`` is what the
    file says. ``condition`` is that of the predecessor's files.
    """

    person: str
    property_name: str
    name: str
    response: str
    label: bool
    is_right: bool | None
    trial_num: int = 0
    condition: str = "prediction"


@dataclass(frozen=True)
class PeopleDialect:
    """How people's files are written."""

    layout: Layout
    is_one_file: bool
    answers: tuple[str, str]
    traps: Collection[Trap]
    seed: int


def befallen(sittings: Sequence[Sitting], trap: Trap) -> list[Answer]:
    """List the answers that a trap befalls."""
    if trap is Trap.CHANGED_ANSWERS:
        return [sittings[_CHANGED].answers[1]]
    if trap is Trap.DISAGREEING_LABELS:
        return [sittings[_DISAGREEING].answers[0]]
    return [sitting.answers[1] for index, sitting in enumerate(sittings) if index % 5 == _BEFALLS[trap]]


def unknown_name(answer: Answer) -> str:
    """Name a trial that no list holds, beside one that lists do."""
    return f"{answer.trial_id.rsplit('/', 1)[0]}/9{answer.trial_id[-3:]}"


def practice_names(property_: str) -> list[str]:
    """Name the trials with which people of a property were familiarised."""
    return [f"{property_.lower()}_familiarization/{number:04d}" for number in range(N_PRACTICE)]


def practised_trials(sittings: Sequence[Sitting], trials: Sequence[Trial]) -> list[Trial]:
    """Pick the test trials on which two people practised: one judged it later, too; the other did not."""
    first, second = sittings[0], sittings[1]
    judged = {answer.trial_id for answer in second.answers}
    others = (t for t in trials if t.property_name == second.property_name and t.trial_id not in judged)
    return [next(t for t in trials if t.trial_id == first.answers[0].trial_id), next(others)]


def make_rows(sittings: Sequence[Sitting], trials: Sequence[Trial], dialect: PeopleDialect) -> list[Row]:
    """Make the rows of all people, in the order in which they sat."""
    by_id = {trial.trial_id: trial for trial in trials}
    touched = {
        trap: set(befallen(sittings, trap))
        for trap in (*_BEFALLS, Trap.CHANGED_ANSWERS, Trap.DISAGREEING_LABELS)
        if trap in dialect.traps
    }
    disagreeing = {answer.trial_id for answer in touched.get(Trap.DISAGREEING_LABELS, ())}
    practised = practised_trials(sittings, trials) if Trap.PRACTICE_ON_TEST_TRIALS in dialect.traps else []
    rows: list[Row] = []
    for index, sitting in enumerate(sittings):
        own = list(_practice(sitting, practised[index : index + 1], dialect))
        for answer in sitting.answers:
            trial = by_id[answer.trial_id]
            label = trial.label != (trial.trial_id in disagreeing)
            own += _befall(_plain_row(answer, trial, label, dialect), answer, touched, dialect)
        rows += _number(own)
    return _spell(rows, dialect)


def _plain_row(answer: Answer, trial: Trial, label: bool, dialect: PeopleDialect) -> Row:
    said = dialect.answers[not answer.is_yes]
    name = _name(trial, dialect)
    return Row(answer.person, trial.property_name, name, said, label, is_right=answer.is_yes == label)


def _number(rows: Sequence[Row]) -> list[Row]:
    """Number a person's rows from 0; a row that is there twice keeps its number."""
    numbered: list[Row] = []
    for place, row in enumerate(rows):
        is_repeated = place > 0 and row is rows[place - 1]
        numbered.append(numbered[-1] if is_repeated else replace(row, trial_num=place))
    return numbered


def _name(trial: Trial, dialect: PeopleDialect) -> str:
    return _suffixed(trial.pair_id if Trap.NAMES_WITHOUT_COPY in dialect.traps else trial.trial_id, dialect)


def _suffixed(name: str, dialect: PeopleDialect) -> str:
    return name if dialect.layout is Layout.AGGREGATED else f"{name}_img"


def _practice(sitting: Sitting, practised: Sequence[Trial], dialect: PeopleDialect) -> Iterator[Row]:
    """Yield what came before the trials that count."""
    yes, no = dialect.answers
    practice = Row(sitting.person, sitting.property_name, "", yes, label=True, is_right=True)
    if Trap.NEXT_RESPONSES in dialect.traps:
        yield replace(practice, response="Next", is_right=None, condition="instructions")
    if Trap.PRACTICE_TRIALS in dialect.traps:
        for place, name in enumerate(practice_names(sitting.property_name)):
            said = (no if place % 2 else yes, place % 2 == 0)
            yield replace(
                practice, name=f"{name}_img", response=said[0], is_right=said[1], condition="familiarization"
            )
    for trial in practised:
        yield replace(
            practice,
            name=_name(trial, dialect),
            response=no,
            label=trial.label,
            is_right=not trial.label,
            condition="familiarization",
        )


def _befall(
    row: Row, answer: Answer, touched: Mapping[Trap, Collection[Answer]], dialect: PeopleDialect
) -> Iterator[Row]:
    """Yield a row as it stands in the file, with what stands beside it."""
    traps = {trap for trap, answers in touched.items() if answer in answers}
    if Trap.NEXT_RESPONSES in dialect.traps and answer.trial_id.endswith("0"):
        yield replace(row, response="Next", is_right=None)  # the video was watched, then it was judged
    if Trap.EMPTY_RESPONSES in traps:
        yield replace(row, response="", is_right=None)
    elif Trap.CONTRADICTED_RESPONSES in traps:
        yield replace(row, is_right=not row.is_right)
    else:
        yield row
    if Trap.DUPLICATE_ANSWERS in traps:
        yield row
    if Trap.CHANGED_ANSWERS in traps:
        yield replace(row, response=dialect.answers[answer.is_yes], is_right=not row.is_right)
    if Trap.UNKNOWN_TRIALS in traps:
        yield replace(row, name=_suffixed(unknown_name(answer), dialect))


def _spell(rows: list[Row], dialect: PeopleDialect) -> list[Row]:
    if Trap.MIXED_SPELLINGS not in dialect.traps:
        return rows
    spelled = []
    for row in rows:
        pair = SPELLINGS[row.trial_num % len(SPELLINGS)]
        said = dialect.answers.index(row.response) if row.response in dialect.answers else None
        spelled.append(row if said is None else replace(row, response=pair[said]))
    return spelled


def game_of(person: str, seed: int) -> str:
    """Name the session of a person as the experiment's server does."""
    return f"{stream(seed, f'game of {person}').getrandbits(32):08x}-game"


def service_columns(person: str, seed: int) -> dict[str, str]:
    """Make the further ids that the recruiting service passes along."""
    rng = stream(seed, f"service ids of {person}")
    return {
        "workerId": person,
        "studyId": f"{stream(seed, 'study').getrandbits(96):024x}",
        "sessionId": f"{rng.getrandbits(96):024x}",
    }


def private_columns(person: str, seed: int) -> dict[str, str]:
    """Make what is nobody's business."""
    rng = stream(seed, f"private matters of {person}")
    return {
        "age": str(rng.randrange(18, 80)),
        "gender": rng.choice(["female", "male", "non-binary"]),
        "comments": f"fun, but slow; write to {person}@example.com",
        "ip_address": f"192.0.2.{rng.randrange(256)}",
    }
