"""The few exceptions of the package: a broken instance, reference or input file, never a bad submission."""


class LeaderboardError(Exception):
    """Something outside the program is wrong, and the message says what to do about it.

    Parameters
    ----------
    message
        What was found and where, in one line.
    hint
        What to do about it, or an empty text.
    """

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.hint = hint


class InstanceError(LeaderboardError):
    """There is no leaderboard instance here, or a file cannot be read or written."""


class BrokenReferenceError(LeaderboardError):
    """The files in ``reference/`` cannot be used for grading."""


class SourceError(LeaderboardError):
    """A file to be imported or converted does not have the expected shape."""
