"""What the website is made of: the reference, people's scores, submissions with their files, and boards."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from leaderboard.comparing import Comparison
from leaderboard.errors import InstanceError
from leaderboard.grading import Scores, Yardstick, grade_people, list_scopes, subset_masks
from leaderboard.ids import SLUG_RULE, is_slug
from leaderboard.instance import PREDICTIONS_FILE, PUBLISHED_FILE, SUBMISSION_FILE, Instance
from leaderboard.ledger import load_ledger, published_dirs
from leaderboard.metrics.accuracy import Booleans
from leaderboard.metrics.pairs import find_pairs
from leaderboard.models import Score, Track
from leaderboard.models.benchmark import OVERALL
from leaderboard.models.ledger import LedgerLine
from leaderboard.models.published import PublishedNumber
from leaderboard.ranking import Board, Entry, Row, load_entry, rank_entries
from leaderboard.reference import Reference
from leaderboard.reference.published import read_published
from leaderboard.submission import read_submission
from leaderboard.website.neighbours import compare_neighbours
from leaderboard.website.texts import NO_TEXTS, Texts

DOWNLOADS = (PREDICTIONS_FILE, SUBMISSION_FILE)
"""Results are part of the files for programs already; a third copy would be an eighth of a large site."""


@dataclass(frozen=True)
class Publication:
    """A graded submission, the files that are offered for download, name to bytes, and its public record."""

    entry: Entry
    files: dict[str, bytes]
    history: tuple[LedgerLine, ...] = ()


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
    published
        Figures of papers, which are never ranked.
    comparisons
        Of submissions at the top of each board, board by board.
    texts
        What maintainers say.
    record
        The public record: what was added, graded again or withdrawn, in the order of time.
    """

    reference: Reference
    people: Scores
    publications: tuple[Publication, ...]
    boards: tuple[Board, ...]
    published: tuple[PublishedNumber, ...] = ()
    comparisons: tuple[Comparison, ...] = ()
    texts: Texts = NO_TEXTS
    record: tuple[LedgerLine, ...] = ()

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
    """Read all submissions but withdrawn ones, each once, so that what is offered is what was checked.

    Raises
    ------
    InstanceError
        If one has no result or one that does not belong to its files, if its folder's name is no slug, or
        if the ledger cannot be understood.
    """
    publications, ledger = [], load_ledger(instance)
    for folder in published_dirs(instance):
        location = instance.display_path(folder)
        if not is_slug(folder.name):
            raise InstanceError(f"{location} cannot be published under this name", f"a slug is {SLUG_RULE}")
        raw = read_submission(folder, location)
        entry = load_entry(raw, reference)
        files = {file.name: file.content for file in raw.files if file.content is not None}
        history = tuple(line for line in ledger.lines if line.slug == entry.slug)
        publications.append(Publication(entry, {name: files[name] for name in DOWNLOADS}, history))
    return tuple(publications)


def load_published(instance: Instance) -> tuple[PublishedNumber, ...]:
    """Read the figures of papers, if there are any.

    Raises
    ------
    SourceError
        If the file is malformed.
    """
    file = instance.reference_file(PUBLISHED_FILE)
    return read_published(file) if file.is_file() else ()


def gather(
    reference: Reference,
    publications: Sequence[Publication],
    published: Sequence[PublishedNumber] = (),
    texts: Texts = NO_TEXTS,
    *,
    record: Sequence[LedgerLine] = (),
) -> Material:
    """Rank the submissions, compare those at the top, and score people."""
    entries = [publication.entry for publication in publications]
    yardstick = Yardstick.of(reference)
    ranked = (rank_entries(entries, track, yardstick=yardstick) for track in _default_first(reference))
    boards = tuple(board for board in ranked if board.track.default or board.ranked or board.partial)
    return Material(
        reference=reference,
        people=grade_people(reference, yardstick=yardstick),
        publications=tuple(sorted(publications, key=lambda publication: publication.entry.slug)),
        boards=boards,
        published=tuple(published),
        comparisons=tuple(compare_neighbours(boards, yardstick)),
        texts=texts,
        record=tuple(record),
    )


def _default_first(reference: Reference) -> list[Track]:
    return sorted(reference.benchmark.tracks, key=lambda track: not track.default)
