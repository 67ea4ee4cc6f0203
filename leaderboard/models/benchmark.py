"""The definition of a benchmark (``benchmark.toml``) and the seal of its files (``manifest.json``)."""

from collections import Counter
from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from leaderboard.models.metadata import Auxiliary, Protocol, Selection, Testing, Training
from leaderboard.models.strict import StrictModel

if TYPE_CHECKING:
    from fractions import Fraction

ReferenceKind = Literal["official", "synthetic"]
OVERALL = "overall"
PROTOCOL_KEYS = ("training", "testing", "auxiliary", "selection")

Name = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_.-]{0,63}$")]
Sha256 = Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]


def _check_share(text: str) -> str:
    numerator, _, denominator = text.partition("/")
    if not (_is_whole(numerator) and _is_whole(denominator)) or int(denominator) == 0:
        raise ValueError("must be a fraction such as 2/3")
    if int(numerator) > int(denominator):
        raise ValueError("must lie between 0 and 1")
    return text


def _is_whole(text: str) -> bool:
    return text.isascii() and text.isdigit() and len(text) <= 9  # noqa: PLR2004  (more than enough)


def _to_fraction(share: str) -> "Fraction":
    from fractions import Fraction  # start-up: judging a submission needs no fractions

    return Fraction(share)


Share = Annotated[str, AfterValidator(_check_share)]


class Grading(StrictModel):
    """How the benchmark is graded; ``easy`` and ``hard`` are exact fractions as text."""

    easy: Share
    hard: Share
    resamples: int = Field(ge=1, le=1_000_000)
    seed: int = Field(ge=0)

    @property
    def easy_above(self) -> "Fraction":
        """A pair is easy if a member's human accuracy is above this."""
        return _to_fraction(self.easy)

    @property
    def hard_below(self) -> "Fraction":
        """A pair is hard if a member's human accuracy is below this."""
        return _to_fraction(self.hard)


class Property(StrictModel):
    """A latent property, its file of trials and the number of trials expected in it."""

    name: Name
    file: str = Field(pattern=r"^[A-Za-z0-9_-]+\.csv$")
    aliases: tuple[str, ...] = Field(default=(), strict=False)
    trials: int = Field(ge=1)


class Scenario(StrictModel):
    """A scenario of one property; the number of trials is checked only if it is given."""

    id: Name
    title: str
    property: str
    trials: int | None = Field(default=None, ge=1)


class Track(StrictModel):
    """One board: the submissions whose protocol has all the values that are given here."""

    id: Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9-]*$")]
    title: str
    default: bool = False
    training: Training | None = None
    testing: Testing | None = None
    auxiliary: Auxiliary | None = None
    selection: Selection | None = None

    @property
    def conditions(self) -> dict[str, str]:
        """The protocol values that a submission of this track has."""
        values = {key: getattr(self, key) for key in PROTOCOL_KEYS}
        return {key: value for key, value in values.items() if value is not None}

    def accepts(self, protocol: Protocol) -> bool:
        """Tell whether a submission with this protocol belongs here."""
        return all(getattr(protocol, key) == value for key, value in self.conditions.items())


class Source(StrictModel):
    """An official file: an empty checksum is trusted on first use and then locked in the manifest.

    ``member`` is the path of a file inside the archive at ``url``; the checksum is then of that file alone,
    because large archives are not read whole. ``*`` stands for several files whose names are nobody's
    business, such as people's; the checksum is then that of theirs, sorted, one on each line.
    """

    what: str
    url: str
    member: str = ""
    sha256: str = Field(default="", pattern=r"^([0-9a-f]{64})?$")
    etag: str = ""
    last_modified: str = ""


class Design(StrictModel):
    """How people were asked, as far as that is known; a difference is a finding of ``reference check``.

    ``sets`` is how many different sets of trials the people of a property saw, no two with a trial in common.
    """

    per_property: int | None = Field(default=None, ge=1)
    trials_per_person: int | None = Field(default=None, ge=1)
    sets: int | None = Field(default=None, ge=1)


class Benchmark(StrictModel):
    """The whole of ``benchmark.toml``; ``licence`` is that of the official files."""

    name: Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9_-]*$")]
    title: str
    version: str
    question: str
    licence: str = ""
    grading: Grading
    properties: tuple[Property, ...] = Field(min_length=1, strict=False)
    scenarios: tuple[Scenario, ...] = Field(min_length=1, strict=False)
    tracks: tuple[Track, ...] = Field(min_length=1, strict=False)
    sources: tuple[Source, ...] = Field(default=(), strict=False)
    people: Design = Field(default_factory=Design)

    @model_validator(mode="after")
    def _check_names(self) -> Self:
        names = [OVERALL, *(p.name for p in self.properties), *(s.id for s in self.scenarios)]
        _refuse_repeated("properties and scenarios must have distinct names", names)
        _refuse_repeated("properties must have distinct files", (p.file for p in self.properties))
        known = {p.name for p in self.properties}
        for scenario in self.scenarios:
            if scenario.property not in known:
                raise ValueError(f"scenario {scenario.id} names the unknown property {scenario.property!r}")
        for name in sorted(known - {s.property for s in self.scenarios}):
            raise ValueError(f"property {name} has no scenario")
        return self

    @model_validator(mode="after")
    def _check_tracks(self) -> Self:
        _refuse_repeated("tracks must have distinct ids", (t.id for t in self.tracks))
        if sum(track.default for track in self.tracks) != 1:
            raise ValueError("exactly one track must have default = true")
        for index, track in enumerate(self.tracks):
            for other in self.tracks[index + 1 :]:
                if not any(
                    other.conditions.get(key, value) != value for key, value in track.conditions.items()
                ):
                    raise ValueError(
                        f"tracks {track.id} and {other.id} overlap: a submission must fit only one"
                    )
        return self

    @property
    def default_track(self) -> Track:
        """The track that is shown first."""
        return next(track for track in self.tracks if track.default)

    def find_track(self, protocol: Protocol) -> Track | None:
        """Find the track that a protocol belongs to, if there is one."""
        return next((track for track in self.tracks if track.accepts(protocol)), None)

    def scenarios_of(self, property_name: str) -> tuple[Scenario, ...]:
        """The scenarios of one property, in the order of the definition."""
        return tuple(s for s in self.scenarios if s.property == property_name)


class Manifest(StrictModel):
    """The seal: what kind of reference this is, where it came from, and the checksum of each file."""

    kind: ReferenceKind
    sources: tuple[Source, ...] = Field(default=(), strict=False)
    files: dict[str, Sha256]
    digest: Sha256


def _refuse_repeated(rule: str, names: Iterable[str]) -> None:
    repeated = sorted(name for name, count in Counter(names).items() if count > 1)
    if repeated:
        raise ValueError(f"{rule}: {', '.join(repeated)} appears twice")
