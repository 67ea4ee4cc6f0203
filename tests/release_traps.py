"""What can be odd about the released files, each oddity switchable alone."""

from collections.abc import Collection
from enum import Enum, auto


class Layout(Enum):
    """How people's answers are laid out."""

    LONG = auto()  # one row for each answer, in the predecessor's columns
    BY_PERSON = auto()  # one row for each person, one column for each trial
    BY_TRIAL = auto()  # one row for each trial, one column for each person
    AGGREGATED = auto()  # one row for each trial: share of right answers and number of answers


class Trap(Enum):
    """An oddity; the comment says what ``Truth.touched`` names for it, if anything."""

    # In the lists of trials.
    FILENAMES_WITHOUT_COPY = "`filenames` lacks the folder with scenario and copy: <config>/<NNNN>_img.mp4"
    FILENAMES_OF_PAIRS = "`filenames` lacks only the copy: <scenario>/<config>/<NNNN>_img.mp4"
    COPY_FOLDER_MP4 = "folders read <scenario>-copy<k>_mp4"
    CONFIG_COMMAS = "configs hold commas, so cells are quoted"
    SAME_LABEL_PAIRS = "the first pair of each scenario has the same label twice"  # pair ids
    REPEATED_ROW = "a trial is listed twice, with the same label"  # trial ids
    CONTRADICTORY_ROW = "a trial is listed twice, with both labels; the first row is right"  # trial ids
    CRLF = "lines end in CRLF"
    BYTE_ORDER_MARK = "files begin with a UTF-8 byte-order mark"
    SPLIT_LIST = "the first property's list is split over two files"  # names of the two files
    READOUT_LIST = "a folder readout/ holds lists of training trials under the same names"  # its trial ids
    BLANK_LINES = "files end in blank lines"
    LOWER_CASE_LABELS = "labels are true/false"
    NUMERIC_LABELS = "labels are 1/0 (wins over LOWER_CASE_LABELS)"
    MISSING_TRIAL = "the last trial of the first scenario is in no file"  # trial ids
    UNKNOWN_SCENARIO = "the first list holds a pair of a scenario that the benchmark lacks"  # trial ids

    # In people's files.
    PRACTICE_TRIALS = "everyone begins with four familiarisation trials, which no list holds"  # their names
    PRACTICE_ON_TEST_TRIALS = "two people practised on test trials; only `condition` says so"  # trial ids
    NEXT_RESPONSES = "screens to be clicked away are rows, with the response Next"
    EMPTY_RESPONSES = "some answers are lost: response and correctness are empty"  # "person trial_id"
    SERVICE_IDS = "people have the recruiting service's ids of 24 hex digits, in several columns"
    PRIVATE_COLUMNS = "age, gender, comment and IP address stand beside the answers"
    CONTRADICTED_RESPONSES = "some rows' correctness contradicts response and label"  # "person trial_id"
    DISAGREEING_LABELS = "people's files give a trial another label than the list"  # trial ids
    DUPLICATE_ANSWERS = "some rows are there twice"  # "person trial_id"
    CHANGED_ANSWERS = "somebody answered a trial twice, differently; Truth has the first"  # "person trial_id"
    UNKNOWN_TRIALS = "some answers are about trials that no list holds"  # their names
    MIXED_SPELLINGS = "answers are spelled YES, yes, Yes, 1 and True"
    LABELLESS = "people's files have no column with the label"
    RESPONSELESS = "people's files have no response, only label and correctness"
    NAMES_WITHOUT_COPY = "people's files name trials without their copy, so pairs, not trials"  # names used
    STREAK_RATERS = "the first person of each property only ever answered YES"  # people
    ALTERNATING_RATERS = "the second person of each property alternated YES and NO"  # people
    BOTH_MEMBERS = "the third person of each property judged both members of two pairs"  # people


LIST_TRAPS = tuple(Trap)[: list(Trap).index(Trap.PRACTICE_TRIALS)]
PEOPLE_TRAPS = tuple(Trap)[len(LIST_TRAPS) :]

_NEEDS_ROWS = {
    Trap.PRACTICE_ON_TEST_TRIALS,
    Trap.NEXT_RESPONSES,
    Trap.CONTRADICTED_RESPONSES,
    Trap.DISAGREEING_LABELS,
    Trap.DUPLICATE_ANSWERS,
    Trap.CHANGED_ANSWERS,
    Trap.LABELLESS,
    Trap.RESPONSELESS,
}
_NEEDS_ANSWERS = _NEEDS_ROWS | {
    Trap.PRACTICE_TRIALS,
    Trap.EMPTY_RESPONSES,
    Trap.SERVICE_IDS,
    Trap.PRIVATE_COLUMNS,
    Trap.MIXED_SPELLINGS,
}
_IMPOSSIBLE: dict[Layout, Collection[Trap]] = {
    Layout.LONG: (),
    Layout.BY_PERSON: _NEEDS_ROWS,
    Layout.BY_TRIAL: _NEEDS_ROWS | {Trap.PRIVATE_COLUMNS},
    Layout.AGGREGATED: _NEEDS_ANSWERS,
}


def traps_for(layout: Layout) -> tuple[Trap, ...]:
    """List the traps that a layout can hold."""
    return tuple(trap for trap in Trap if trap not in _IMPOSSIBLE[layout])
