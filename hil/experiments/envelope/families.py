"""What is drawn for a random loop: twelve families around one parameter set, tuned to none."""

from dataclasses import dataclass, replace
from math import inf

import numpy as np

from controller.laws.bounds import Bounds, approach_speed
from hil.experiments.envelope.spring_plant import SpringRig

CONTACT = 0.4
"""N; 8 sigma of one sample."""
LONGEST_APPROACH = 2.0
"""s; the delay is measured within one."""


@dataclass(frozen=True, slots=True)
class Family:
    """What the loops of one family share; stiffness in N/m, lag in s, gap in m, push in m/s.

    period: ms. push: inward speed in contact, None for the approach speed. free_approach: drawn
    from 1 to 10 mm/s and not by `approach_speed`. beyond: plants up to so many times `stiffest`.
    """

    name: str
    period: int = 8
    softest: float = 1e3
    stiffest: float = 50e3
    lag: float = 0.03
    nearest: float = 1e-3
    farthest: float = 6e-3
    push: float | None = None
    bandwidth: float = 0.75
    kink: bool = False
    free_approach: bool = False
    beyond: float = 1.0


FAMILIES = (
    Family("push as approach, 125 Hz"),
    Family("push as approach, 500 Hz", period=2),
    Family("push 16 mm/s, 125 Hz", push=16e-3),
    Family("push 16 mm/s, 500 Hz", push=16e-3, period=2),
    Family("gap .1 to 1 mm, delay not measured", nearest=1e-4, farthest=1e-3),
    Family("approach 1 to 10 mm/s, against the rule", free_approach=True),
    Family("kink, 125 Hz", kink=True),
    Family("kink, 500 Hz", kink=True, period=2),
    Family("lag to 60 ms", lag=0.06),
    Family(".5 to 200 N/mm in one set", softest=500.0, stiffest=200e3),
    Family("to twice the stiffest, outside the contract", beyond=2.0),
    Family("bandwidth .5", bandwidth=0.5),
)


def draw_rig(family: Family, force: float, rng: np.random.Generator) -> SpringRig:
    """A plant within the family's ranges; a kink somewhere on the way to `force`, N."""
    low, high = np.log(family.softest), np.log(family.stiffest * family.beyond)
    rig = SpringRig(
        stiffness=float(np.exp(rng.uniform(low, high))),
        gap=rng.uniform(family.nearest, family.farthest),
        sensor_latency=int(rng.integers(1, 9)),
        command_latency=int(rng.integers(1, 9)),
        lag=rng.uniform(0.004, family.lag),
        bumps=0.2e-3,
        wavelength=rng.uniform(0.06, 0.12),
        friction=rng.uniform(0.1, 0.3),
    )
    if not family.kink:
        return rig
    beyond = float(np.exp(rng.uniform(low, high)))
    return replace(rig, kink=rng.uniform(0.1, 1.0) * force, beyond=beyond)


def draw_bounds(family: Family, force: float, reaction: float, rng: np.random.Generator) -> Bounds:
    """Speeds for this force (N) and reaction time (s); no force stop, which would hide a blow."""
    approach = min(5e-3, approach_speed(force, CONTACT, family.stiffest, reaction))
    if family.free_approach:
        approach = rng.uniform(1e-3, 10e-3)
    push = approach if family.push is None else family.push
    return Bounds(approach=approach, push=push, contact=CONTACT, stop=inf)


def within_reach(rig: SpringRig, approach: float) -> SpringRig:
    """The same rig no further away than the longest approach at this speed, m/s."""
    return replace(rig, gap=min(rig.gap, LONGEST_APPROACH * approach))
