"""What the website is made of: the reference, people's scores, submissions with their files, and boards."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from leaderboard.errors import InstanceError
from leaderboard.grading import Scores, Yardstick, grade_people, list_scopes, subset_masks
from leaderboard.ids import SLUG_RULE, is_slug
from leaderboard.instance import PREDICTIONS_FILE, RESULT_FILE, SUBMISSION_FILE, Instance
from leaderboard.metrics.accuracy import Booleans
from leaderboard.metrics.pairs import find_pairs
from leaderboard.models import Score, Track
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Board, Entry, Row, load_entry, rank_entries
from leaderboard.reference import Reference
from leaderboard.submission import read_submission

DOWNLOADS = (PREDICTIONS_FILE, SUBMISSION_FILE, RESULT_FILE)


@dataclass(frozen=True)
class Publication:
    """A graded submission and the files that are offered for download, name to bytes."""

    entry: Entry
    files: dict[str, bytes]


@dataclass(frozen=True)
class Count:
    """How much stands behind a score: trials, pairs, and trials that people judged."""

    n: int
    n_pairs: int
    n_rated: int


@dataclass(frozen=True)
class Material:
    """Everything that pages and exports are made from.

    Attributes
    ----------
    people
        People's own scores; empty without human data.
    boards
        The default track's, then those of other tracks that have submissions.
    """

    reference: Reference
    people: Scores
    publications: tuple[Publication, ...]
    boards: tuple[Board, ...]

    @cached_property
    def standings(self) -> dict[str, tuple[Board, Row]]:
        """The board and row of each submission that competes on one, by slug."""
        return {
            row.entry.slug: (board, row) for board in self.boards for row in (*board.ranked, *board.partial)
        }

    @property
    def has_pairs(self) -> bool:
        """Whether the reference's trials come in pairs."""
        return self.count(OVERALL).n_pairs > 0

    @property
    def unplaced(self) -> tuple[Entry, ...]:
        """Submissions whose protocol fits no track; they have pages, but no board shows them."""
        entries = (publication.entry for publication in self.publications)
        return tuple(e for e in entries if not e.is_baseline and e.slug not in self.standings)

    def people_score(self, metric: str, scope: str, subset: str) -> Score | None:
        """Look up a score of people themselves; None where there is none."""
        scores = self.people.get(scope, {}).get(subset)
        return scores.metrics.get(metric) if scores else None

    def count(self, scope: str, subset: str = "all") -> Count:
        """Count what stands behind a score of the whole reference; nothing where it has no such trials."""
        return self._counts.get((scope, subset), Count(0, 0, 0))

    @cached_property
    def _counts(self) -> dict[tuple[str, str], Count]:
        masks = subset_masks(self.reference)
        return {
            (scope.name, subset): self._count(scope.mask & mask)
            for scope in list_scopes(self.reference, masks["all"])
            for subset, mask in masks.items()
        }

    def _count(self, mask: Booleans) -> Count:
        people = self.reference.people
        n_rated = int((people.n[mask] > 0).sum()) if people else 0
        return Count(int(mask.sum()), len(find_pairs(self.reference.pairs[mask])), n_rated)


def load_publications(instance: Instance, reference: Reference) -> tuple[Publication, ...]:
    """Read all submissions by slug, each once, so that what is offered is what was checked.

    Raises
    ------
    InstanceError
        If one has no result or one that does not belong to its files, or if its folder's name is no slug.
    """
    publications = []
    for folder in instance.submission_dirs():
        location = instance.display_path(folder)
        if not is_slug(folder.name):
            raise InstanceError(f"{location} cannot be published under this name", f"a slug is {SLUG_RULE}")
        raw = read_submission(folder, location)
        entry = load_entry(raw, reference)
        files = {file.name: file.content for file in raw.files if file.content is not None}
        publications.append(Publication(entry, {name: files[name] for name in DOWNLOADS}))
    return tuple(publications)


def gather(reference: Reference, publications: Sequence[Publication]) -> Material:
    """Rank the submissions and score people."""
    entries = [publication.entry for publication in publications]
    yardstick = Yardstick.of(reference)
    boards = (rank_entries(entries, track, yardstick=yardstick) for track in _default_first(reference))
    return Material(
        reference=reference,
        people=grade_people(reference, yardstick=yardstick),
        publications=tuple(sorted(publications, key=lambda publication: publication.entry.slug)),
        boards=tuple(board for board in boards if board.track.default or board.ranked or board.partial),
    )


def _default_first(reference: Reference) -> list[Track]:
    return sorted(reference.benchmark.tracks, key=lambda track: not track.default)
