"""What a reference holds, for a terminal and as JSON."""

from dataclasses import asdict

from rich.text import Text

from leaderboard.files import canonical_json
from leaderboard.metrics.undefined import Estimate, Undefined
from leaderboard.models import Score
from leaderboard.reference import Reference
from leaderboard.reference.describing import Description, PartDescription
from leaderboard.report.terminal import (
    ABSENT,
    Terminal,
    format_percent,
    new_table,
    reference_banner,
    render_tables,
)

COLUMNS = ("", "trials", "YES", "pairs", "rated", "people each", "people, %", "easy", "hard", "both")


def render_description(
    description: Description, reference: Reference, *, terminal: Terminal | None = None
) -> str:
    """Tabulate trials, pairs, people and easy and hard pairs by property and scenario."""
    table = new_table(COLUMNS)
    for part in description.parts:
        is_property = part.kind == "property"
        name = part.title if is_property else f"  {part.title}"
        table.add_row(name, *_cells(part), style="bold" if is_property else "")
    heading = reference_banner(reference)
    heading.append(
        f"\n{description.n_trials:,} trials, {description.n_pairs:,} pairs; {_people(description)}"
    )
    notes = (
        "easy, hard: pairs with a member above or below the benchmark's bounds; both: pairs that are both."
    )
    dropped = [Text(f"dropped: {trial_id}: {why}") for trial_id, why in description.dropped.items()]
    return render_tables([heading, "", table, Text(notes, "dim"), *dropped], terminal or Terminal())


def render_description_json(description: Description) -> str:
    """Render the description for programs; what is undefined is null."""
    data = asdict(description)
    data["human_accuracy"] = _value(description.human_accuracy)
    for part, described in zip(data["parts"], description.parts, strict=True):
        part["human_accuracy"] = _value(described.human_accuracy)
    return canonical_json(data)


def _cells(part: PartDescription) -> list[str]:
    n_trials = str(part.n_trials)
    if part.expected is not None and part.expected != part.n_trials:
        n_trials += f" of {part.expected}"
    each = ABSENT if not part.n_rated else f"{part.ratings_min}-{part.ratings_max}"
    percent = format_percent(Score(value=_value(part.human_accuracy)))
    counts = (part.n_easy, part.n_hard, part.n_easy_and_hard)
    yes = f"{part.n_yes_labels}"
    return [n_trials, yes, str(part.n_pairs), str(part.n_rated), each, percent, *map(str, counts)]


def _people(description: Description) -> str:
    if not description.n_responses:
        return "no human data"
    text = f"{description.n_responses:,} responses to {description.n_rated:,} trials"
    if description.n_people is None or description.trials_per_person is None:
        return f"{text}; single people are not known"
    low, high = description.trials_per_person
    each = f"{low}" if low == high else f"{low}-{high}"
    return f"{text} by {description.n_people} people with {each} trials each"


def _value(estimate: Estimate) -> float | None:
    return None if isinstance(estimate, Undefined) else round(estimate, 6)
