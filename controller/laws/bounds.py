"""The limits that hold for every law, and the approach speed that makes a touch harmless."""

from dataclasses import dataclass
from math import inf


@dataclass(frozen=True, slots=True)
class Bounds:
    """What one force-controlled axis may do, whatever its law proposes.

    approach: inward speed in free air, m/s. push: inward speed in contact, m/s; equal to `approach`
    for assembly, more for following a surface that moves away. retreat: outward speed, m/s.
    speed: of any command, and of the withdrawal after a force stop, m/s. acceleration: m/s²; keep
    push and retreat below acceleration x 8 ms, or the ramp lags behind the law (50 mm/s at 2 m/s²
    costs most of the stability margin). contact: push above which the tool touches, N; 8 sigma of
    one raw sample, or what a tare leaves. stop: push of one sample that ends the run, N.
    sensor_range: beyond it a sample is none, N. lowest, highest: travel, m. silence: without a
    reading for longer, knowledge of the contact is dropped, s.
    """

    approach: float = 2.5e-3
    push: float = 2.5e-3
    retreat: float = 16e-3
    speed: float = 50e-3
    acceleration: float = 2.0
    contact: float = 0.4
    stop: float = 12.0
    sensor_range: float = 500.0
    lowest: float = -inf
    highest: float = inf
    silence: float = 0.02

    def __post_init__(self) -> None:
        for name in ("approach", "push", "retreat", "speed", "acceleration", "silence"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be positive, found {getattr(self, name)}")
        if not 0.0 < self.contact < self.stop:
            raise ValueError(f"0 < contact < stop does not hold: {self.contact}, {self.stop} N")
        if not self.contact < self.sensor_range < inf:
            raise ValueError(f"sensor_range must be finite and above contact: {self.sensor_range}")
        if not self.lowest < self.highest:
            raise ValueError(f"travel from {self.lowest} to {self.highest} m is empty")

    def check(self, force: float) -> None:
        """Raise ValueError for a reference force (N) that no contact could hold within them."""
        if not self.contact < force < self.stop:
            raise ValueError(
                f"a reference force lies between {self.contact} and {self.stop} N, found {force}"
            )


def reaction_time(latency: float, lag: float, period: float) -> float:
    """From a touch to the first motion away from it, s.

    latency: of sensor and command together. lag: the arm's time constant. 2.5 periods: one to
    sample, one to interpolate the command, half of one as the mean age of a sample.
    """
    return latency + lag + 2.5 * period


def approach_speed(force: float, contact: float, stiffest: float, reaction: float) -> float:
    """Fastest approach (m/s) whose first blow stays below force (N) on the stiffest contact (N/m).

    Until the law reacts the tool goes on, so the blow is contact + stiffest * speed * reaction.
    """
    return (force - contact) / (stiffest * reaction)
