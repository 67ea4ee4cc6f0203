"""People's files: the layouts."""

from collections.abc import Callable, Sequence

from release_lists import render_table
from release_people import PeopleDialect, Row, game_of, private_columns, service_columns
from release_traps import Layout, Trap
from release_trials import stream

Table = list[list[str]]


def write_people(rows: Sequence[Row], dialect: PeopleDialect) -> dict[str, bytes]:
    """Render people's rows into one file, or one for each property, by name."""
    kind = "human_accuracy" if dialect.layout is Layout.AGGREGATED else "human_responses"
    layout = _LAYOUTS[dialect.layout]
    if dialect.is_one_file:
        return {f"{kind}.csv": render_table(layout(rows, dialect), dialect.traps)}
    files = {}
    for property_ in dict.fromkeys(row.property_name for row in rows):
        own = [row for row in rows if row.property_name == property_]
        files[f"{kind}-{property_.lower()}.csv"] = render_table(layout(own, dialect), dialect.traps)
    return files


def _long(rows: Sequence[Row], dialect: PeopleDialect) -> Table:
    left_out = {
        column
        for column, trap in (
            ("target_hit_zone_label", Trap.LABELLESS),
            ("response", Trap.RESPONSELESS),
        )
        if trap in dialect.traps
    }
    records = [_record(row, dialect) for row in rows]
    header = [column for column in records[0] if column not in left_out]
    return [header, *([record[column] for column in header] for record in records)]


def _record(row: Row, dialect: PeopleDialect) -> dict[str, str]:
    seconds = stream(dialect.seed, f"time of {row.person} {row.trial_num}").random()
    return {
        "gameID": game_of(row.person, dialect.seed),
        "trialNum": str(row.trial_num),
        "prolificIDAnon": row.person,
        "stim_ID": row.name,
        "response": row.response,
        "target_hit_zone_label": str(row.label) if row.name else "",
        "correct": "" if row.is_right is None else str(row.is_right),
        "choices": str(list(dialect.answers)),
        "rt": f"{600 + 3000 * seconds:.1f}",
        "condition": row.condition,
        **_beside(row.person, dialect),
    }


def _beside(person: str, dialect: PeopleDialect) -> dict[str, str]:
    """Make the columns about the person that nobody asked for."""
    service = service_columns(person, dialect.seed) if Trap.SERVICE_IDS in dialect.traps else {}
    private = private_columns(person, dialect.seed) if Trap.PRIVATE_COLUMNS in dialect.traps else {}
    return {**service, **private}


def _by_person(rows: Sequence[Row], dialect: PeopleDialect) -> Table:
    names = sorted({row.name for row in rows})
    cells = {(row.person, row.name): row.response for row in rows}
    people = list(dict.fromkeys(row.person for row in rows))
    table = [["prolificIDAnon", *_beside(people[0], dialect), *names]]
    for person in people:
        answers = [cells.get((person, name), "") for name in names]
        table.append([person, *_beside(person, dialect).values(), *answers])
    return table


def _by_trial(rows: Sequence[Row], _: PeopleDialect) -> Table:
    people = list(dict.fromkeys(row.person for row in rows))
    cells = {(row.name, row.person): row.response for row in rows}
    names = sorted({row.name for row in rows})
    table = [["stim_ID", *people]]
    return table + [[name, *(cells.get((name, person), "") for person in people)] for name in names]


def _aggregated(rows: Sequence[Row], _: PeopleDialect) -> Table:
    right: dict[str, list[bool]] = {}
    for row in rows:
        right.setdefault(row.name, []).append(bool(row.is_right))
    return [
        ["stim_ID", "correct", "c"],
        *([name, repr(sum(each) / len(each)), str(len(each))] for name, each in sorted(right.items())),
    ]


_LAYOUTS: dict[Layout, Callable[[Sequence[Row], PeopleDialect], Table]] = {
    Layout.LONG: _long,
    Layout.BY_PERSON: _by_person,
    Layout.BY_TRIAL: _by_trial,
    Layout.AGGREGATED: _aggregated,
}
