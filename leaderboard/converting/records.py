"""Records of logs, and what all formats take from them: a trial's name, a text, an answer."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from leaderboard.converting.answers import Reading, parse_answer
from leaderboard.converting.log import Answer
from leaderboard.errors import SourceError
from leaderboard.reference.cells import quote

# Where logs name a trial, in the order in which they are looked for; beside a path an id may be a number.
ID_FIELDS = ("trial_id", "stimulus_id", "stimulus", "stimulus_name", "video", "video_path", "id", "video_id")
MODEL_FIELD = "model"
TRUTH_FIELDS = ("target", "label", "ground_truth")

_ABSENT = object()


@dataclass(frozen=True)
class Options:
    """What a log does not say by itself.

    Attributes
    ----------
    id_field, answer_field, probability_field
        Names of fields; None looks for the usual ones. A dot leads into an object: ``metadata.video``.
    is_logit
        Whether the number is the logarithm of the odds.
    id_map
        Trials by the names that the log has for them.
    """

    id_field: str | None = None
    answer_field: str | None = None
    probability_field: str | None = None
    is_logit: bool = False
    id_map: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Record:
    """One row, line or object of a log: where it is, and its fields."""

    file: str
    line: int
    fields: Mapping[str, object]
    unit: str = ""

    def has(self, path: str) -> bool:
        """Tell whether a field is there, be it null."""
        return self._look_up(path) is not _ABSENT

    def find(self, path: str) -> object:
        """Return a field's value, or None if it is not there; a dot leads into an object."""
        value = self._look_up(path)
        return None if value is _ABSENT else value

    def _look_up(self, path: str) -> object:
        if path in self.fields:
            return self.fields[path]
        value: object = self.fields
        for part in path.split("."):
            value = value.get(part, _ABSENT) if isinstance(value, dict) else _ABSENT
        return value

    def find_text(self, path: str) -> str:
        """Return a field that is a text; an empty one if it is null or not there.

        Raises
        ------
        SourceError
            If it is something else.
        """
        value = self.find(path)
        if value is None or isinstance(value, str):
            return value or ""
        raise self.error(f"{path} is {quote(repr(value))}, not a text")

    def require_text(self, path: str) -> str:
        """Return a field that is a text or null; unlike `find_text` it must be there.

        Raises
        ------
        SourceError
            If it is something else, or not there.
        """
        if not self.has(path):
            raise self.error(f"lacks {path}")
        return self.find_text(path)

    def find_items(self, path: str) -> list[object]:
        """Return a field that is a list.

        Raises
        ------
        SourceError
            If it is something else, or not there.
        """
        value = self.find(path)
        if isinstance(value, list):
            return value
        raise self.error(
            f"{path} is {quote(repr(value))}, not a list" if value is not None else f"lacks {path}"
        )

    def error(self, message: str, hint: str = "") -> SourceError:
        """Make the exception that says what is wrong with this record."""
        place = f"{self.file}, {self.unit} {self.line}" if self.unit else f"{self.file}:{self.line}"
        return SourceError(f"{place}: {message}", hint)


def choose_field(record: Record, wanted: str | None, usual: Sequence[str], option: str) -> str:
    """Tell which field of a log holds what is needed: the one asked for, or the only usual one.

    Parameters
    ----------
    record
        The log's first.
    wanted
        What was asked for by ``option``, or None.
    usual
        Fields of which exactly one must be there if none was asked for.

    Raises
    ------
    SourceError
        If it is not there, or there are several.
    """
    found = [name for name in ([wanted] if wanted else usual) if record.has(name)]
    if wanted and not found:
        raise record.error(f"has no field {quote(wanted)}; there are {_list_fields(record)}")
    if len(found) == 1:
        return found[0]
    if found:
        raise record.error(f"has the fields {' and '.join(found)}", f"say with {option} which it is")
    raise record.error(
        f"has none of the fields {', '.join(usual)}", f"say with {option}; there are {_list_fields(record)}"
    )


def choose_id_field(record: Record, options: Options, *, inside: str = "") -> str:
    """Tell which field holds the name of the trial: the one asked for, or the first usual one.

    ``inside`` is the object in which the usual ones are looked for.
    """
    if options.id_field is None:
        for name in (f"{inside}{name}" for name in ID_FIELDS):
            if record.has(name):
                return name
    return choose_field(record, options.id_field, [f"{inside}{name}" for name in ID_FIELDS], "--id-field")


def find_model(record: Record) -> str:
    """Return the model that a record of a general log says it is of; empty if it does not name one."""
    model = record.find(MODEL_FIELD)
    return model if isinstance(model, str) else ""


def name_trial(record: Record, id_field: str, options: Options) -> str:
    """Return the trial's name as the log has it, or, where there is a map, as the map has it.

    Raises
    ------
    SourceError
        If the field is neither a text nor a whole number, or is empty.
    """
    value = record.find(id_field)
    if isinstance(value, bool) or not isinstance(value, str | int) or value == "":
        found = "empty" if value in (None, "") else quote(repr(value))
        raise record.error(f"{id_field} is {found} where a trial should be named")
    return options.id_map.get(str(value), str(value))


def make_answer(
    record: Record,
    trial_name: str,
    reading: Reading,
    *,
    repeat: str = "",
    outcome: bool | None = None,
    scenario_name: str = "",
) -> Answer:
    """Make an answer of a record and of what its text says."""
    return Answer(
        file=record.file,
        line=record.line,
        trial_name=trial_name,
        scenario_name=scenario_name,
        probability=reading.probability,
        outcome=outcome,
        status=reading.status,
        repeat=repeat,
        unit=record.unit,
    )


def parse_target(target: object) -> bool | None:
    """Tell what a log takes to be the true outcome, if it says so in YES or NO.

    >>> parse_target("yes"), parse_target(["No"]), parse_target(1)
    (True, False, None)
    """
    if isinstance(target, list) and len(target) == 1:
        target = target[0]
    return parse_answer(target).outcome if isinstance(target, str) else None


def find_truth(record: Record, answer_field: str) -> bool | None:
    """Tell what a general log takes to be the true outcome, where it has a usual field for it.

    >>> [find_truth(Record("a", 1, {"label": value}), "text") for value in ("No", 1, "0", "fell")]
    [False, True, False, None]
    """
    names = (name for name in TRUTH_FIELDS if name != answer_field and record.has(name))
    value = record.find(next(names, ""))
    return {"1": True, "true": True, "0": False, "false": False}.get(str(value).lower(), parse_target(value))


def parse_texts(texts: Sequence[object], record: Record) -> Iterator[tuple[str, Reading]]:
    """Read the texts that a record holds for one trial, numbered from 1.

    Raises
    ------
    SourceError
        If one is no text.
    """
    for number, text in enumerate(texts, 1):
        if not isinstance(text, str):
            raise record.error(f"answer {number} is {quote(repr(text))}, not a text")
        yield str(number), parse_answer(text)


def _list_fields(record: Record) -> str:
    names = sorted(record.fields)
    return quote(", ".join(names))
