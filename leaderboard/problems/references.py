"""What can be wrong with a reference, and what a reader of its scores should know."""

from leaderboard.problems.catalogue import Severity

_ERRORS = {
    # References that cannot be used.
    "reference-file-missing": "A file that the reference needs is not there.",
    "reference-unreadable": "A file of the reference is a link or folder, too large, or not UTF-8.",
    "reference-definition": "benchmark.toml is not TOML, or what it says contradicts itself.",
    "reference-malformed": "A table of the reference is not a regular CSV file.",
    "reference-header": "A table of the reference has other columns than it must have.",
    "reference-value": "A cell of the reference holds what is not allowed there.",
    "reference-scenario": "A trial names a scenario that is unknown or belongs to another property.",
    "reference-duplicate": "A trial is listed twice.",
    "reference-unknown-trial": "Human data name a trial that no trial list has.",
    "reference-yes-count": "More people said YES to a trial than judged it.",
    "reference-repeated-response": "A person judged a trial twice.",
    "reference-aggregate": "The counts of human_trials.csv are not those of the single responses.",
    "reference-manifest": "manifest.json cannot be read, or contradicts itself.",
    "reference-seal": "A file of the reference is not the one that manifest.json sealed.",
    "reference-errata": "errata.toml is not TOML, or what it says is not allowed.",
}
_WARNINGS = {
    # References that depart from what their definition expects.
    "reference-trial-count": "A property or scenario does not have as many trials as it should.",
    "reference-incomplete-pair": "A pair does not have two trials.",
    "reference-split-pair": "The trials of a pair are in different scenarios.",
    "reference-equal-labels": "Both trials of a pair end the same way.",
    "reference-copies": "The trials of a pair are not copy 0 and copy 1.",
    "reference-participant-id": "A participant's name is not opaque.",
    "reference-kind": "The manifest's kind contradicts the trial ids.",
    "reference-published": "The file of published numbers cannot be read.",
    "reference-stray-file": "A file lies in the reference that is no part of it.",
    # Errata that cannot be used, or that say nothing.
    "reference-errata-trial": "errata.toml drops a trial that no trial list has.",
    "reference-errata-unused": "errata.toml accepts what was not found.",
}
_NOTES = {
    # Facts about a reference that a reader should know.
    "reference-no-pairs": "The trials of a property come without pairs.",
    "reference-imbalance": "YES and NO are not equally frequent.",
    "reference-unrated": "Nobody judged some of the trials.",
    "reference-both-members": "People saw both trials of a pair.",
    # How people were asked and how they answered.
    "reference-people-count": "Not as many people judged a property as the definition says.",
    "reference-trials-per-person": "People judged more or fewer trials than the definition says.",
    "reference-sets": "People saw other sets of trials than the definition says.",
    "reference-rater": "A person's answers form a pattern that looking at the trials would hardly make.",
}

MEANINGS = {Severity.ERROR: _ERRORS, Severity.WARNING: _WARNINGS, Severity.NOTE: _NOTES}
