"""Single faults: each one of the catalogue in each of its phases, or random ones."""

from collections.abc import Iterator, Mapping
from math import isfinite
from types import MappingProxyType
from typing import Final

import numpy as np

from hil.cell.faults.catalogue import CATALOGUE
from hil.cell.faults.event import Event, Kind
from hil.cell.faults.row import Parameter, Phase, Row, Value
from hil.cell.faults.schedule import Fault
from hil.cell.faults.span import Span
from hil.cell.faults.trigger import Trigger

MET: Final = ("G2", "P3", "P4", "L1", "L2", "L3", "L4", "L5")
"""Rows that act only where the job comes upon them: over before that, they would show nothing."""
SHOWS: Final[Mapping[tuple[str, Phase], Mapping[str, Value]]] = MappingProxyType(
    {("P3", Phase.SEARCH): {"what": "kink"}}
)
"""What of a row can act in a phase at all: a block is met only once the slot is found."""
SPREAD: Final = 4.0
"""Random parameters lie within this factor of their defaults, and within their ranges."""
LATEST: Final = 60
"""Control periods after the phase has begun, by which a random fault begins."""
SOON: Final = 10
"""The same for what the job has to meet: its search may be over after a few steps."""
LONGEST: Final = 250
"""Control periods that half of the random lasting faults last at most; the others do to the end."""


def each() -> Iterator[tuple[Fault, Phase]]:
    """Every fault with its defaults in every phase where it makes sense, soon after that begins."""
    for row in CATALOGUE:
        for phase in row.phases:
            yield Fault(row.id, SHOWS.get((row.id, phase), {}), _trigger(row, phase, 3)), phase


def drawn(rng: np.random.Generator) -> tuple[Fault, Phase]:
    """One fault with random parameters, phase, moment and length."""
    row = CATALOGUE[rng.integers(len(CATALOGUE))]
    phase = row.phases[rng.integers(len(row.phases))]
    values = {parameter.name: _value(parameter, rng) for parameter in row.parameters}
    values |= SHOWS.get((row.id, phase), {})
    brief = row.lasting and not row.start and rng.random() < 0.5 and row.id not in MET
    lasts = Span(cycles=int(rng.integers(1, LONGEST))) if brief else None
    after = int(rng.integers(SOON if row.id in MET else LATEST))
    return Fault(row.id, values, _trigger(row, phase, after), lasts), phase


def _trigger(row: Row, phase: Phase, after: int) -> Trigger:
    """In free air once the arm moves, unless free air is all that the fault is for."""
    if row.start:
        return Trigger()
    early = phase is Phase.FREE and row.phases != (Phase.FREE,)
    name = "pick up" if early else phase.value
    return Trigger(event=Event(Kind.PHASE, name), offset=Span(cycles=after))


def _value(parameter: Parameter, rng: np.random.Generator) -> Value:
    default = parameter.default
    if parameter.choices or isinstance(default, str):
        return parameter.choices[rng.integers(len(parameter.choices))]
    low, high = parameter.low, parameter.high
    if default == 0.0:
        # Zero switches an effect off; a tenth of a bounded range switches it on.
        bounded = isfinite(low) and isfinite(high) and high <= 1.0
        return float(rng.uniform(low, high)) * 0.1 if bounded and rng.random() < 0.5 else 0.0
    factor = SPREAD ** rng.uniform(-1.0, 1.0)
    value = min(max(default * factor, low), high)
    return float(round(value)) if parameter.whole else float(value)
