"""The settings that all models of files share."""

from pydantic import BaseModel, ConfigDict


class StrictModel(BaseModel):
    """Frozen, without unknown keys, and without silent conversions such as ``"1"`` to 1."""

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        strict=True,
        allow_inf_nan=False,
        defer_build=True,  # start-up: a command builds only the models that it uses
    )
