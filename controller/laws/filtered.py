"""Force and its rate from raw samples, both low-passed."""

from math import exp, pi


class FilteredForce:
    """Two equal poles in a row: the rate of a single one would carry 3.1 N/s of sensor noise at
    10 Hz, the rate of two carries 0.4 N/s. cutoff: Hz. period: s, shared evenly by its samples.
    """

    __slots__ = ("_omega", "_period", "_second", "_started", "force")

    def __init__(self, cutoff: float, period: float) -> None:
        if not cutoff > 0.0:
            raise ValueError(f"a cut-off is positive, found {cutoff} Hz")
        self._omega = 2.0 * pi * cutoff
        self._period = period
        self.reset()

    def reset(self) -> None:
        self._started = False
        self.force = 0.0
        self._second = 0.0

    def feed(self, samples: tuple[float, ...]) -> None:
        """Take a period's samples, N, oldest first; the first one of all is the start."""
        if not self._started:
            self._started = True
            self.force = self._second = samples[0]
        share = 1.0 - exp(-self._omega * self._period / len(samples))
        for sample in samples:
            self.force += share * (sample - self.force)
            self._second += share * (self.force - self._second)

    @property
    def rate(self) -> float:
        """Of the force, N/s."""
        return self._omega * (self.force - self._second)
