"""Which trials the names in people's files mean."""

from collections.abc import Mapping

from leaderboard.trial_names import Resolution, Resolved, TrialNames


class TrialMatcher:
    """Finds trials by name, each name once.

    Parameters
    ----------
    labels
        The label of every trial of the reference, True for YES, by id in the reference's order.
    """

    def __init__(self, labels: Mapping[str, bool]) -> None:
        self.labels = labels
        self._names = TrialNames(labels)
        self._found: dict[str, Resolution] = {}

    def resolve(self, name: str) -> Resolution:
        """Tell which trial a name means, if it is exactly one; blanks around it do not matter."""
        name = name.strip()
        if name not in self._found:
            self._found[name] = self._names.resolve(name)
        return self._found[name]

    def find(self, name: str) -> str | None:
        """Return the one trial that a name means, or None."""
        found = self.resolve(name)
        return found.trial_id if isinstance(found, Resolved) else None
