"""Domain randomisation: which uncertain numbers of a rig are drawn per seed, and from where."""

from pydantic import Field, model_validator

from hil.cell.rig.section import Section


class Axis(Section):
    """One uncertain number: `key` as in `connector.friction`, uniform between two values.

    low and high are written as the key itself is: with its unit, if it has one.
    """

    key: str = Field(pattern=r"^[a-z_]+(\.[a-z_]+)+$")
    low: str | float
    high: str | float


class Randomisation(Section):
    """The axes; `enabled: false` keeps them as documentation of what is uncertain."""

    enabled: bool = False
    axes: tuple[Axis, ...] = ()

    @model_validator(mode="after")
    def _distinct(self) -> "Randomisation":
        keys = [axis.key for axis in self.axes]
        if len(keys) != len(set(keys)):
            raise ValueError(f"each axis may be named once, found {keys}")
        return self
