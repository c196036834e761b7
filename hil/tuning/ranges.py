"""Where one parameter is looked for: a range of numbers or a choice of words."""

from typing import Annotated, TypeAlias

from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag, model_validator


class Part(BaseModel):
    """A group of a study file."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class Range(Part):
    """Where a parameter is looked for, in its own units. log: by its logarithm. whole: integers."""

    low: float
    high: float
    log: bool = False
    start: float | None = None
    whole: bool = False

    @model_validator(mode="after")
    def _sane(self) -> "Range":
        if not self.low < self.high:
            raise ValueError(f"low ({self.low:g}) must lie below high ({self.high:g})")
        if self.log and self.low <= 0.0:
            raise ValueError(f"a logarithmic range begins above 0, found {self.low:g}")
        if self.start is not None and not self.low <= self.start <= self.high:
            raise ValueError(f"start ({self.start:g}) lies outside {self.low:g} to {self.high:g}")
        ends = [end for end in (self.low, self.high, self.start) if end is not None]
        if self.whole and any(end != int(end) for end in ends):
            raise ValueError("a range of whole numbers has whole ends and start")
        return self


class Choice(Part):
    """One of these; start: which first."""

    choices: tuple[bool | int | float | str, ...] = Field(min_length=2)
    start: bool | int | float | str | None = None

    @model_validator(mode="after")
    def _sane(self) -> "Choice":
        if self.start is not None and self.start not in self.choices:
            raise ValueError(f"start ({self.start}) is none of the choices")
        return self


def _kind(written: object) -> str:
    """Which of the two is meant, so that an error speaks of that one."""
    chosen = isinstance(written, Choice) or (isinstance(written, dict) and "choices" in written)
    return "choice" if chosen else "range"


Looked: TypeAlias = Annotated[
    Annotated[Range, Tag("range")] | Annotated[Choice, Tag("choice")], Discriminator(_kind)
]
