"""In what a new reference differs from the one that is there."""

from collections.abc import Mapping
from dataclasses import dataclass

from leaderboard.files import sha256_hex
from leaderboard.reference.data import Reference


@dataclass(frozen=True)
class Difference:
    """What a new reference changes; each field holds trial ids or file names in alphabetical order.

    Attributes
    ----------
    added, removed
        Trials that only the new or only the old one has.
    relabelled
        Trials that end otherwise.
    rated_otherwise
        Trials that another number of people judged, or judged otherwise.
    files
        Files of the reference whose bytes differ, are new or gone.
    """

    added: tuple[str, ...]
    removed: tuple[str, ...]
    relabelled: tuple[str, ...]
    rated_otherwise: tuple[str, ...]
    files: tuple[str, ...]

    def __bool__(self) -> bool:
        """Whether there is any difference: files that are equal byte for byte leave none."""
        return bool(self.files)


def compare_references(old: Reference, new: Reference, contents: Mapping[str, bytes]) -> Difference:
    """Compare the reference that is there with a new one.

    Parameters
    ----------
    old, new
        The two.
    contents
        The new one's files by name.
    """
    both = [trial_id for trial_id in new.trial_ids if trial_id in old.trial_index]
    before, after = _describe_trials(old), _describe_trials(new)
    checksums = {name: sha256_hex(content) for name, content in contents.items()}
    names = checksums.keys() | old.manifest.files.keys()
    return Difference(
        added=tuple(sorted(new.trial_index.keys() - old.trial_index.keys())),
        removed=tuple(sorted(old.trial_index.keys() - new.trial_index.keys())),
        relabelled=tuple(sorted(t for t in both if before[t][0] != after[t][0])),
        rated_otherwise=tuple(sorted(t for t in both if before[t][1:] != after[t][1:])),
        files=tuple(sorted(n for n in names if checksums.get(n) != old.manifest.files.get(n))),
    )


def _describe_trials(reference: Reference) -> dict[str, tuple[int, int, int]]:
    """Map each trial id to its label and how many people judged it and said YES."""
    people = reference.people
    n = [0] * reference.n_trials if people is None else people.n.tolist()
    n_yes = [0] * reference.n_trials if people is None else people.n_yes.tolist()
    return dict(zip(reference.trial_ids, zip(reference.labels.tolist(), n, n_yes, strict=True), strict=True))
