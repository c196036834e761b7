"""Which faults a run meets: one fault, several at once or in turn, a random few of them."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Final, TypeAlias

import numpy as np

from hil.cell.faults.catalogue import row
from hil.cell.faults.row import UNITS, Parameter, Row, Value
from hil.cell.faults.span import Span
from hil.cell.faults.trigger import AT_ONCE, Trigger
from hil.cell.streams import stream

_DEFAULTS: Final[Mapping[str, Value]] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class Fault:
    """kind: id or name of its row; kept as the id. parameters: SI; all of the row's once made.

    duration: None is to the end of the run. FaultError for a kind that does not exist.
    """

    kind: str
    parameters: Mapping[str, Value] = field(default_factory=lambda: _DEFAULTS)
    trigger: Trigger = AT_ONCE
    duration: Span | None = None

    def __post_init__(self) -> None:
        known = row(self.kind)
        filled = {parameter.name: parameter.default for parameter in known.parameters}
        object.__setattr__(self, "kind", known.id)
        object.__setattr__(self, "parameters", filled | dict(self.parameters))

    @property
    def row(self) -> Row:
        return row(self.kind)

    def number(self, name: str) -> float:
        """A numeric parameter, SI."""
        value = self.parameters[name]
        assert not isinstance(value, str), name
        return value

    def word(self, name: str) -> str:
        """A parameter that is one of a few words."""
        return str(self.parameters[name])

    def written(self) -> dict[str, object]:
        """As a schedule file has it; what is default is left out."""
        found: dict[str, object] = {"kind": self.kind}
        begins = self.trigger.written()
        if begins:
            found["trigger"] = begins
        if self.duration is not None:
            found["duration"] = str(self.duration)
        given = {
            parameter.name: _text(parameter, self.parameters[parameter.name])
            for parameter in self.row.parameters
            if self.parameters[parameter.name] != parameter.default
        }
        return found | ({"params": given} if given else {})

    def __str__(self) -> str:
        return f"{self.kind} {self.row.name} ({self.trigger})"


Numbered: TypeAlias = tuple[tuple[int, Fault], ...]
"""Some faults of a run, each with its number in the whole schedule."""


@dataclass(frozen=True, slots=True)
class Schedule:
    """pick: so many of the faults, drawn by the run's seed; None takes all."""

    faults: tuple[Fault, ...] = ()
    pick: int | None = None

    def drawn(self, rng: np.random.Generator) -> "Schedule":
        """The faults of one run, in their order."""
        if self.pick is None:
            return self
        chosen = sorted(rng.choice(len(self.faults), self.pick, replace=False).tolist())
        return Schedule(tuple(self.faults[index] for index in chosen))

    def numbered(self, seed: int) -> Numbered:
        """The faults of the run with this seed."""
        return tuple(enumerate(self.drawn(stream(seed, "faults.pick")).faults))

    def written(self) -> dict[str, object]:
        """As a schedule file has it."""
        found: dict[str, object] = {"faults": [fault.written() for fault in self.faults]}
        return found | ({} if self.pick is None else {"pick": self.pick})


def _text(parameter: Parameter, value: Value) -> Value:
    if isinstance(value, str) or not parameter.unit or parameter.unit == "ppm":
        return value
    if parameter.whole:
        return int(value)
    return f"{value!r} {UNITS.get(parameter.unit, parameter.unit)}"
