"""What columns of people's files are called: by experiments, services and tables of data."""

import re
from collections.abc import Iterable, Mapping, Sequence

from leaderboard.problems import Problems
from leaderboard.reference.cells import quote
from leaderboard.reference.judgements.answers import is_empty, parse_answer
from leaderboard.reference.source_tables import SourceTable

# By what they hold, names of columns as `simplify` makes them, the better ones first. A person may play
# several games, so an id of the person comes before one of the session.
_NAMES = {
    "participant": (
        "prolificid prolificidanon prolificpid prolific workerid worker participantid participant ppid "
        "personid person subjectid subject subjid subj subid userid user respondentid respondent raterid "
        "rater pid gameid game sessionid session idofsession"
    ),
    "trial": (
        "stimid stimulusid stim stimulus stimname stimulusname trialid trial trialname videoid video "
        "videoname videofile filename filenames file stimurl stimulusurl videourl url stimpath fullstimpath "
        "fullstimpaths path clip movie scene"
    ),
    "response": (
        "response responses resp answer choice rating pred prediction judgement judgment yes pyes yesrate "
        "shareyes yesshare propyes yesprop fractionyes meanresponse responsemean meanresp humanmean pcontact"
    ),
    "correct": (
        "correct iscorrect acc accuracy correctness right isright propcorrect pcorrect sharecorrect "
        "meancorrect correctmean humanaccuracy meanaccuracy"
    ),
    "label": (
        "targethitzonelabel targethitzonelabels label labels groundtruth gt truth outcome correctresponse "
        "correctanswer correctchoice expectedresponse expectedanswer answerkey doestargetcontactzone"
    ),
    "count": (
        "c n count counts nraters raters nparticipants participants nsubjects nsubj npeople people "
        "nresponses nanswers nobs ntotal total"
    ),
    "n_yes": "nyes yescount countyes numyes yesses",
}
ROLES = tuple(_NAMES)

# Columns that tell what a row is for.
_CONDITIONS = "condition trialtype trialkind phase block blockname blocktype stage part task type stimtype"

# Further columns of such files, none of which is a person.
_FURTHER = (
    "index rt trialnum trialnumber trialindex trialorder choices practice ispractice attention catch "
    "duration timestamp date time age gender sex comments comment scenario scenarioname scenarios "
    "property copy study studyid config redyellow flipped starphy nonstarphy startframe "
    "startframeforprediction startframeaftercurtain buttonorder set version"
)
_ORDER = ("trialnum", "trialnumber", "trialindex", "trialorder")
CONDITIONS = frozenset(_CONDITIONS.split())
_SYNONYMS = {role: tuple(names.split()) for role, names in _NAMES.items()}
_KNOWN = CONDITIONS.union(_FURTHER.split(), *_SYNONYMS.values())

_BLANKS = re.compile(r"[\s_.-]+")
_INDEX = re.compile(r"(?:unnamed:?[0-9]*)?")


def simplify(name: str) -> str:
    """Reduce a column's name to what does not depend on case, underscores, dots, hyphens and blanks.

    >>> simplify("Stim ID") == simplify("stim_id") == simplify("stimID")
    True
    """
    return _BLANKS.sub("", name).casefold()


def find_order_columns(header: Iterable[str]) -> list[str]:
    """List the columns that number the answers of a person in the order of answering."""
    return [column for column in header if simplify(column) in _ORDER]


def find_columns(header: Iterable[str], role: str) -> list[str]:
    """List the columns whose name says that they hold this, the better ones first."""
    names = _SYNONYMS[role]
    found = [column for column in header if simplify(column) in names]
    return sorted(found, key=lambda column: names.index(simplify(column)))


def is_known(column: str) -> bool:
    """Tell whether a column's name is one that files use or an index, so that it is no person."""
    name = simplify(column)
    return name in _KNOWN or _INDEX.fullmatch(name) is not None


def take_named(header: Sequence[str], columns: Mapping[str, str]) -> dict[str, str]:
    """Find the columns that were named by what they hold, as far as a table has them.

    A column without name cannot be named.
    """
    exact = {column: column for column in header if column}
    simple = {simplify(column): column for column in reversed(exact)}
    found = {role: exact.get(name, simple.get(simplify(name))) for role, name in columns.items()}
    return {role: column for role, column in found.items() if column is not None}


def check_named(tables: Sequence[SourceTable], columns: Mapping[str, str], problems: Problems) -> None:
    """Report every named column that no table has, and names for what no column holds."""
    for role, name in columns.items():
        if role not in ROLES:
            message = f"--columns knows no {quote(role)}; it knows {', '.join(ROLES)}"
            problems.add("import-columns", message, "--columns")
        elif not any(take_named(table.header, {role: name}) for table in tables):
            found = "; ".join(f"{table.file} has {describe_header(table)}" for table in tables)
            message = f"no file has a column {quote(name)} for the {role}"
            problems.add("import-columns", message, "--columns", hint=found)


def describe_header(table: SourceTable) -> str:
    """List the columns of a table by name, but for those whose name may be a person's."""
    shown = [column for column in table.header if column and not _may_be_person(table, column)]
    n_others = len(table.header) - len(shown)
    others = [f"{n_others} more that may be named for people or have no name"] if n_others else []
    return ", ".join([*(quote(column).strip("'") for column in shown), *others])


def name_column(header: Sequence[str], column: str) -> str:
    """Name a column in a message: by its place where its name may be a person's.

    >>> header = ["stim_ID", "5f1c8a0b77aa"]
    >>> [name_column(header, column) for column in header]
    ['stim_ID', 'column 2']
    """
    is_telling = not column or (not is_known(column) and has_digits(column))
    return f"column {header.index(column) + 1}" if is_telling else column


def has_digits(text: str) -> bool:
    """Tell whether a text has digits, as nearly all ids have."""
    return any(character.isdigit() for character in text)


def _may_be_person(table: SourceTable, column: str) -> bool:
    if is_known(column):
        return False
    cells = {row[column] for row in table.rows}
    has_answers = any(parse_answer(cell) is not None for cell in cells)
    return has_answers or all(map(is_empty, cells)) or has_digits(column)
