"""Tables of VLMEvalKit, ``<model>_<dataset>.tsv`` and the like: index, question, answer, prediction."""

from collections.abc import Sequence
from pathlib import Path

from leaderboard.converting.answers import READER_VERSION, parse_answer
from leaderboard.converting.log import Answer, Run, name_run
from leaderboard.converting.record_files import read_all, require_own_map
from leaderboard.converting.records import Options, make_answer, name_trial, parse_target


def read_runs(files: Sequence[Path], options: Options) -> list[Run]:
    """Read tables of one model as one run, named after the first file.

    The column ``answer`` is the truth; what the model said is in ``prediction``. Sheets (.xlsx) are to be
    saved as CSV first.

    Raises
    ------
    SourceError
        If a file is malformed.
    """
    require_own_map(files, options, "index")
    answers: list[Answer] = []
    for record in read_all(files):
        if not record.has("prediction"):
            raise record.error("lacks prediction, so it is no table of VLMEvalKit's inference")
        answers.append(
            make_answer(
                record,
                name_trial(record, options.id_field or "index", options),
                parse_answer(record.find_text("prediction")),
                outcome=parse_target(record.find("answer")),
            )
        )
    return [Run(name_run(files[0].stem), tuple(answers), READER_VERSION)]
