"""What every section of a rig file shares: unknown keys are errors, values never change."""

from pydantic import BaseModel, ConfigDict


class Section(BaseModel):
    """A part of a rig file: frozen, SI inside, quantities with units outside."""

    model_config = ConfigDict(extra="forbid", frozen=True)
