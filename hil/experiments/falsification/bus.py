"""The CAN bus of the study: frames lost or late by the faults in force."""

from collections import deque
from collections.abc import Sequence

from drivers.nrs.session import Heard
from hil.cell.faults.injector import Injector


class FaultyBus:
    """Samples travel at once unless C1 (lost) or C2 (late, in order) is in force."""

    def __init__(self, injector: Injector) -> None:
        self._injector = injector
        self._way: deque[tuple[int, tuple[Heard, Heard]]] = deque()

    def put(self, samples: Sequence[tuple[int, tuple[Heard, Heard]]]) -> None:
        """A period's samples: when each leaves the node, ns, and its frames."""
        first = samples[0][0]
        lost = [False] * len(samples)
        for drop in self._injector.of("C1"):
            drop.felt(first)
            dice = drop.draws(first).random(len(samples))
            lost = [
                gone or die < drop.fault.number("share")
                for gone, die in zip(lost, dice, strict=True)
            ]
        late = 0
        for delay in self._injector.of("C2"):
            delay.felt(first)
            late += round(delay.fault.number("mean") * 1e9)
        for (t, frames), gone in zip(samples, lost, strict=True):
            if not gone:
                ahead = self._way[-1][0] if self._way else 0  # what left later arrives later
                self._way.append((max(t + late, ahead), frames))

    def due(self, t: int) -> list[Heard]:
        """The frames that have arrived by t, ns."""
        arrived: list[Heard] = []
        while self._way and self._way[0][0] <= t:
            arrived.extend(self._way.popleft()[1])
        return arrived
