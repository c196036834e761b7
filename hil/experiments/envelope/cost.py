"""What one governed update of a force law costs in processor time, in closed loop."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from time import thread_time_ns

import numpy as np

from controller.laws.bounds import Bounds
from controller.laws.build import build
from controller.laws.interface import AxisLaw, AxisReading, Reference
from hil.experiments.envelope.spring_loop import Span, run
from hil.experiments.envelope.spring_plant import SpringRig

RATES = (125, 500)
"""Hz."""
FORCE = 5.0
SPAN = Span(approach=4000, still=4000, moving=8000)
"""Free air, a hold, and a slide: every branch of a law is in it."""


@dataclass(frozen=True, slots=True)
class Cost:
    """median_us, p95_us: of one update, its own clock reading included. updates: measured."""

    law: str
    rate_hz: int
    updates: int
    median_us: float
    p95_us: float


def costs(laws: Sequence[str]) -> Iterator[Cost]:
    """Each law at each rate; ValueError for a law that there is not."""
    for law in laws:
        for rate in RATES:
            period = 1000 // rate
            timed = _Timed(build(law, None, Bounds(), period * 1_000_000))
            rng = np.random.default_rng(1)
            run(timed, SpringRig(), lambda _: Reference(FORCE), SPAN, period=period, rng=rng)
            median, p95 = np.percentile(timed.spent, [50.0, 95.0]) * 1e-3
            yield Cost(law, rate, len(timed.spent), float(median), float(p95))


class _Timed:
    """Times every step of the axis it wraps, ns of this thread."""

    def __init__(self, axis: AxisLaw) -> None:
        self._axis = axis
        self.spent: list[int] = []

    @property
    def velocity(self) -> float:
        return self._axis.velocity

    def reset(self, position: float) -> None:
        self._axis.reset(position)

    def step(self, reading: AxisReading, reference: Reference) -> float:
        begin = thread_time_ns()
        step = self._axis.step(reading, reference)
        self.spent.append(thread_time_ns() - begin)
        return step
