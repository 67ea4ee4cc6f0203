"""What a recipe is, what it is told, and what it makes of official files."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from leaderboard.models import Benchmark, Source
from leaderboard.problems import Problems
from leaderboard.reference.fetching import Remote
from leaderboard.reference.source_files import SourceFile


@dataclass(frozen=True)
class ImportOptions:
    """How to read official files that leave something open.

    Attributes
    ----------
    columns
        Names of columns in files of human data by what they hold (``participant``, ``trial``, ``response``
        and so on); what is not named is recognised by content.
    allow_unmatched
        Whether answers that name no trial are left out instead of refused.
    """

    columns: Mapping[str, str] = field(default_factory=dict)
    allow_unmatched: bool = False


@dataclass(frozen=True)
class ImportedProperty:
    """What was imported of one property.

    ``human_accuracy`` is the mean over the trials that people judged, in [0, 1]; None if they judged none.
    """

    name: str
    n_trials: int
    n_rated: int
    human_accuracy: float | None


@dataclass(frozen=True)
class Draft:
    """A reference as a recipe reads it from official files, before anything is written.

    Attributes
    ----------
    contents
        The reference's files by name, all but the manifest.
    properties
        What was imported, by property.
    sources
        The official files that were used, with the checksums of what was read.
    dropped
        Why trials that are in the lists cannot be graded, by their id; they get errata.
    """

    contents: Mapping[str, bytes]
    properties: tuple[ImportedProperty, ...]
    sources: tuple[Source, ...]
    dropped: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Recipe:
    """One benchmark's way from official files to a reference.

    Attributes
    ----------
    name, title
        How commands and people call the benchmark.
    render_definition
        Writes ``benchmark.toml`` for a new instance; one that is there already is used instead.
    is_wanted
        Tells from a file's path whether it may be an official file that the recipe reads.
    list_remotes
        Says what to fetch, from the sources that a definition names.
    draft
        Makes the reference of a definition from the files, and collects every oddity of them; None if they
        cannot be made one, and then a problem is an error that says why.
    """

    name: str
    title: str
    render_definition: Callable[[], bytes]
    is_wanted: Callable[[str], bool]
    list_remotes: Callable[[Benchmark], tuple[Remote, ...]]
    draft: Callable[[Sequence[SourceFile], bytes, ImportOptions, Problems], Draft | None]
