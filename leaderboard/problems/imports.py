"""What can be wrong with official files, and what importing finds in them."""

from leaderboard.problems.catalogue import Severity

_ERRORS = {
    # Official files that cannot be made a reference.
    "import-no-trials": "No official file lists test trials.",
    "import-trial-name": "A list names no trial where it should, or not which copy it is.",
    "import-label": "A label in a list is neither True nor False.",
    "import-contradiction": "Two columns of a list name different trials, so that a label could be either's.",
    "import-unknown-scenario": "A list has trials of a scenario that benchmark.toml does not define.",
    # What importing people's answers finds in files of unknown layout.
    "import-columns": "A column named with --columns is in no file, or named for what none holds.",
    "import-no-judgements": "No official file holds answers of people or counts that can be used.",
    "import-match-rate": "Not every answer of people names exactly one trial.",
    "import-answer": "An answer of people is neither YES nor NO.",
    "import-answer-meaning": "It is unclear which answers of people mean YES.",
    "import-people-value": "A number in a file of human data is not what its column must hold.",
    "import-two-counts": "Two rows with counts of people give different ones for the same trial.",
}
_WARNINGS = {
    # What importing official files finds in them.
    "import-unmatched": "A name in an official file fits no trial; its row is left out.",
    "import-ambiguous": "A name in an official file fits several trials; its row is left out.",
    "import-repeated": "An official file judges the same trial twice; neither row is used.",
    "import-scenario": "An official file of one scenario judges a trial of another; its row is left out.",
    "import-count": "Human accuracy times the number of people is not whole; the row is left out.",
    "import-version": "An official file is not the version that its recipe was written for.",
    "import-label-conflict": "A trial is listed with both labels; it is dropped.",
    "import-other-name": "A side column of a list names another trial than its video; the video counts.",
    "import-start-frame": "A start frame is no whole number, or differs between two rows of a trial.",
    # What importing people's answers finds in files of unknown layout.
    "import-answer-left-out": "An answer of people is neither YES nor NO; it is left out.",
    "import-answer-contradiction": "A response contradicts its correctness; the response is taken.",
    "import-assumed-yes": "People's answers are 0 and 1, of unknown meaning; 1 is taken as YES.",
    "import-people-label": "A file of human data gives a trial another label; the list's counts.",
    "import-changed-answer": "A person answers a trial twice, differently; the first answer counts.",
    "import-no-participant": "An answer names no participant where others do; it is left out.",
    "import-participant-numbers": "Participants have plain numbers, and the same ones in several files.",
    "import-only-counts": "Single responses are not known of all judged trials; only counts are kept.",
    "import-counts-differ": "Counts of people are not those of the single responses, which are taken.",
}
_NOTES = {
    # What importing official files finds in them.
    "import-listed-twice": "A trial is listed more than once, always with the same label; it counts once.",
    "import-other-split": "A list is for training or for fitting readouts; it is not used.",
    "import-no-people": "There are no human data among the official files.",
    "import-unrated": "People did not judge some trials; they stay, without human data.",
    "import-accuracy": "Two official files give a different human accuracy for the same trials.",
    # What importing people's answers finds in files of unknown layout.
    "import-layout": "How a file of human data is laid out, and which columns were taken for what.",
    "import-match": "How many answers of people name a trial.",
    "import-practice": "Answers to practice trials are left out.",
    "import-non-answer": "Rows of people that hold no answer, or are about no trial, are left out.",
    "import-same-answer": "A person answers a trial twice and alike; the answer counts once.",
    "import-same-file": "A file of human data is there twice and counts once.",
    "import-other-file": "A file beside the human data holds none.",
}

MEANINGS = {Severity.ERROR: _ERRORS, Severity.WARNING: _WARNINGS, Severity.NOTE: _NOTES}
