"""What a maintainer decides about oddities of a reference (``errata.toml``)."""

from typing import Annotated, Self

from pydantic import AfterValidator, Field, model_validator

from leaderboard.models.metadata import Text, check_not_blank
from leaderboard.models.strict import StrictModel

Reason = Annotated[Text, AfterValidator(check_not_blank)]


class Acceptance(StrictModel):
    """Findings that are known and stay: those of a code whose message contains ``where``."""

    code: str
    where: Text = ""
    reason: Reason


class Drop(StrictModel):
    """A trial that is taken out of the reference."""

    trial_id: str
    reason: Reason


class Errata(StrictModel):
    """The whole of ``errata.toml``."""

    accept: tuple[Acceptance, ...] = Field(default=(), strict=False)
    drop: tuple[Drop, ...] = Field(default=(), strict=False)

    @model_validator(mode="after")
    def _check_drops(self) -> Self:
        seen: set[str] = set()
        for drop in self.drop:
            if drop.trial_id in seen:
                raise ValueError(f"the trial {drop.trial_id} is dropped twice")
            seen.add(drop.trial_id)
        return self

    @property
    def reasons(self) -> dict[str, str]:
        """Why each trial is dropped, by its id."""
        return {drop.trial_id: drop.reason for drop in self.drop}
