"""Write reference/published.csv: `python tools/write_published.py TABLES.csv`.

TABLES.csv holds the paper's result tables as numbers, with the columns `table, system, training, testing,
training_trials, auxiliary, property, printed_percent`. What follows stands in running text, or in another
paper. Afterwards the reference is another one: seal it and grade again (docs/maintaining.md).
"""

import sys
from dataclasses import dataclass
from pathlib import Path

from leaderboard.files import csv_text, write_atomic
from leaderboard.instance import PUBLISHED_FILE, Instance, find_instance
from leaderboard.models.benchmark import OVERALL
from leaderboard.reference.published import PUBLISHED_HEADER, read_published
from leaderboard.reference.source_tables import SourceRow, read_source_table

COLUMNS = (
    "table",
    "system",
    "training",
    "testing",
    "training_trials",
    "auxiliary",
    "property",
    "printed_percent",
)
TABLES = {
    "results": "Table 2",
    "training_trials": "Table 3, number of training trials",
    "auxiliary": "Table in the appendix, implicit or explicit inference",
}
N_PROPERTY, N_OVERALL = 192, 768

PHYSIONPP = "Tung et al. (2023), NeurIPS Datasets and Benchmarks"
PHYSIONPP_URL = "https://arxiv.org/abs/2306.15668"
PHYSMIND = "Yang et al. (2026), PhysMind"
PHYSMIND_URL = "https://arxiv.org/abs/2608.04575"
RIGID = (
    "384 of 768 trials, five scenarios: mass_collision_pp, friction_collision_pp, friction_platform_pp, "
    "bouncy_platform_pp, bouncy_wall_pp; not comparable with an overall"
)


@dataclass(frozen=True)
class Quoted:
    """A number that stands outside the paper's tables; fields are the columns of ``published.csv``."""

    source: str
    url: str
    system: str
    scope: str
    metric: str
    printed: str
    note: str
    n: str = ""
    training: str = ""
    testing: str = ""
    training_trials: str = ""
    auxiliary: str = ""


QUOTED = (
    Quoted(
        source=PHYSIONPP,
        url=PHYSIONPP_URL,
        system="People",
        scope=OVERALL,
        metric="accuracy",
        printed="60%",
        note="In the text on people and models; 200 people gave 32 answers each, so it is no k of 768 trials",
    ),
    Quoted(
        source=PHYSIONPP,
        url=PHYSIONPP_URL,
        system="People",
        scope=OVERALL,
        metric="split_half_r",
        printed="0.37",
        note="In the text on people and models; correlation of two halves of the people, not its root",
    ),
    Quoted(
        source=PHYSIONPP,
        url=PHYSIONPP_URL,
        system="SlotFormer",
        training="separate",
        testing="with_property",
        training_trials="2000",
        auxiliary="implicit",
        scope=OVERALL,
        metric="human_r",
        printed="0.12",
        note="In the text on people and models, as the highest of all models",
    ),
    Quoted(
        source=PHYSMIND,
        url=PHYSMIND_URL,
        system="PhysMind",
        training="zero_shot",
        scope="five rigid scenarios",
        metric="accuracy",
        printed="229/384",
        n="384",
        note=RIGID,
    ),
    Quoted(
        source=PHYSMIND,
        url=PHYSMIND_URL,
        system="Gemini-3-Flash, chain of thought",
        training="zero_shot",
        scope="five rigid scenarios",
        metric="accuracy",
        printed="198/384",
        n="384",
        note=RIGID,
    ),
)


def describe_cell(row: SourceRow) -> dict[str, str]:
    """Turn a cell of the paper's tables into a row of ``published.csv``."""
    is_overall = row["property"] == "Overall"
    return {
        "source": PHYSIONPP,
        "url": PHYSIONPP_URL,
        "system": row["system"],
        "training": row["training"],
        "testing": row["testing"],
        "training_trials": row["training_trials"],
        "auxiliary": row["auxiliary"],
        "scope": OVERALL if is_overall else row["property"],
        "metric": "accuracy",
        "printed": row["printed_percent"],
        "n": str(N_OVERALL if is_overall else N_PROPERTY),
        "note": TABLES[row["table"]],
    }


def sort_cells(rows: tuple[SourceRow, ...]) -> list[SourceRow]:
    """Bring what belongs together side by side: tables, protocols, systems, and then the scopes of each."""
    tables, systems = (list(dict.fromkeys(row[name] for row in rows)) for name in ("table", "system"))
    protocols = list(dict.fromkeys(protocol_of(row) for row in rows))
    return sorted(
        rows,
        key=lambda row: (
            tables.index(row["table"]),
            int(row["training_trials"]),
            protocols.index(protocol_of(row)),
            systems.index(row["system"]),
        ),
    )


def protocol_of(row: SourceRow) -> tuple[str, str, str]:
    """Name the protocol of a cell, the number of training trials aside."""
    return row["training"], row["testing"], row["auxiliary"]


def render_published(tables: Path) -> str:
    """Render ``published.csv``: the cells of the tables, then what is quoted."""
    rows = read_source_table(tables, COLUMNS).rows
    cells = [describe_cell(row) for row in sort_cells(rows)] + [vars(quoted) for quoted in QUOTED]
    return csv_text(PUBLISHED_HEADER, ([row[name] for name in PUBLISHED_HEADER] for row in cells))


def main(tables: Path, instance: Instance) -> None:
    """Write the instance's published numbers and read them back."""
    file = instance.reference_file(PUBLISHED_FILE)
    write_atomic(file, render_published(tables).encode())
    print(f"wrote {len(read_published(file))} numbers")


if __name__ == "__main__":
    main(Path(sys.argv[1]), find_instance(Path(__file__).parent))
