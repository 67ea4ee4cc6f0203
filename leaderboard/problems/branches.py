"""What can be wrong with a branch that brings a submission, and with the ledger."""

from leaderboard.problems.catalogue import Severity

_ERRORS = {
    # Branches that do more than add or amend one submission.
    "change-nothing": "The two commits do not differ.",
    "change-outside": "A path outside of the submission's folder changes.",
    "change-several": "More than one submission changes.",
    "change-mode": "A file is marked as a program.",
    "change-frozen": "Something changes that never does once it is published.",
    "change-foreign": "A published submission changes at the hand of somebody else than its contact.",
    "change-baseline": "A submission calls itself a baseline, which only the leaderboard's own are.",
    "change-result": "The committed result is not what grading gives.",
    # Ledgers that are not what a public record must be.
    "ledger-unreadable": "The ledger is a link or folder, too large, or not UTF-8.",
    "ledger-malformed": "The ledger is not the regular CSV file that appending writes.",
    "ledger-value": "A cell of the ledger holds what is not allowed there.",
    "ledger-order": "A line of the ledger contradicts an earlier one.",
    "ledger-rewritten": "A published line of the ledger is changed or gone.",
    "ledger-unrecorded": "A submission's result is not the one that the ledger records last.",
    "ledger-vanished": "A published submission is gone, and no line of the ledger withdraws it.",
    "ledger-result": "A result, or the published one that it replaces, is not there or is none.",
    "ledger-predictions": "Published predictions changed.",
    "ledger-score": "A published number changed, though neither the metrics nor the reference did.",
}
_WARNINGS = {
    # Branches that do more than add or amend one submission.
    "change-contact": "A new submission names somebody else than its sender as contact.",
    "change-unchecked-author": "Nobody said who sent the change, so that was not checked.",
}

MEANINGS = {Severity.ERROR: _ERRORS, Severity.WARNING: _WARNINGS}
