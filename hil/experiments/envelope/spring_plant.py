"""A spring surface in front of a lagging arm, one axis, in numba; for loops without wires.

1 kHz steps. Command latency, linear interpolation over one control period, first-order lag and a
speed limit make the arm; a linear spring without damping (the worst case), bumps, friction and a
kink in stiffness make the contact; noise and quantisation make the sensor. No tool resonance.
"""

from dataclasses import dataclass
from math import exp
from typing import TypeAlias

import numpy as np
from numba import njit
from numpy.typing import NDArray

Array: TypeAlias = NDArray[np.float64]

UNTOUCHED = -1.0
TOUCH = 0.2
"""True push, N, at which the surface counts as reached."""


@dataclass(frozen=True, slots=True)
class SpringRig:
    """stiffness: k_e, N/m. gap: to the surface, m. sensor_latency, command_latency: ms.

    lag: the arm's time constant, s. top_speed: its limit, m/s. bumps, wavelength: height and length
    of the cosine bumps, m, passed at `passing`, m/s. friction: share of the push that the slope
    adds, with stick noise. noise, quantum: of a sample, N. pose_noise, standing: of the measured
    position and the arm's offset from its command, m. kink: true push (N) beyond which the
    stiffness is `beyond` (N/m); 0 for none.
    """

    stiffness: float = 10e3
    gap: float = 5e-3
    sensor_latency: int = 3
    command_latency: int = 3
    lag: float = 0.012
    top_speed: float = 0.25
    bumps: float = 3e-3
    wavelength: float = 0.08
    passing: float = 0.02
    friction: float = 0.2
    noise: float = 0.05
    quantum: float = 0.015
    pose_noise: float = 5e-6
    standing: float = 0.0
    kink: float = 0.0
    beyond: float = 0.0

    def numbers(self, period: int, still: int, surface: float) -> Array:
        """What the kernel reads: period and still time in ms, surface in m."""
        return np.array([
            self.stiffness, surface, self.command_latency, 1.0 - exp(-1e-3 / self.lag),
            self.top_speed * 1e-3, self.bumps, self.wavelength, self.passing * 1e-3, self.friction,
            self.noise, self.quantum, self.standing, self.kink, self.beyond, period, still,
        ])  # fmt: skip


@njit(cache=True)
def advance(  # noqa: PLR0917  numba takes no keywords
    numbers: Array,
    state: Array,
    sent: Array,
    count: int,
    dice: Array,
    begin: int,
    end: int,
    out: Array,
) -> None:
    """Steps the milliseconds from begin up to end.

    state: arm, two ends of the interpolation and when it began, commands taken, touch, way, stick.
    sent: the commands, one a period, the first `count` valid. dice: (N, 3) standard normal.
    out: (N, 3) true push, position, sensor's push.
    """
    k_e, surface, latency, share, most, bumps, wave, passing = numbers[:8]
    friction, noise, quantum, standing, kink, beyond, period, still = numbers[8:]
    x, old, new, since, taken, touch, way, stick = state
    for i in range(begin, end):
        if touch >= 0.0 and i - touch >= still:
            way += passing
        phase = 2.0 * np.pi * way / wave
        height = 0.5 * bumps * (1.0 - np.cos(phase))
        while taken * period + latency <= i and taken < count:
            old = old + (new - old) * min((i - since) / period, 1.0) if taken else sent[0]
            new, since = sent[int(taken)], i
            taken += 1
        if taken > 0:
            aim = old + (new - old) * min((i - since + 1) / period, 1.0)
            x += min(max(share * (aim + standing - x), -most), most)
        depth = surface + height - x
        push = k_e * depth if depth > 0.0 else 0.0
        if kink > 0.0 and push > kink:
            push = kink + beyond * (depth - kink / k_e)
        if touch < 0.0 and push > TOUCH:
            touch = i
        stick = 0.97 * stick + 0.03 * dice[i, 0]
        slope = np.pi * bumps / wave * np.sin(phase)
        push *= 1.0 + friction * slope + (0.05 * friction * stick if way > 0.0 else 0.0)
        felt = push + noise * dice[i, 1]
        if quantum > 0.0:
            felt = np.round(felt / quantum) * quantum
        out[i, 0], out[i, 1], out[i, 2] = push, x, felt
    state[:] = (x, old, new, since, taken, touch, way, stick)
