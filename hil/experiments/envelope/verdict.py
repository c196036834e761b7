"""One random loop: drawn, closed, judged against the peak bound."""

from typing import NamedTuple

import numpy as np

from controller.laws.bounds import Bounds, reaction_time
from controller.laws.build import build
from controller.laws.governor import Governor
from controller.laws.interface import Reference
from controller.laws.soft import SoftSettings
from controller.laws.stiffness import StiffnessSettings
from hil.experiments.envelope.families import (
    CONTACT,
    Family,
    draw_bounds,
    draw_rig,
    within_reach,
)
from hil.experiments.envelope.spring_loop import Span, run
from hil.experiments.envelope.spring_plant import Array, SpringRig
from hil.experiments.force_tracking.figures import LOST, OSCILLATING, settling

SPAN = Span(approach=8000, still=4000, moving=1200)
NOISE = 0.15
"""N: three sigma of a sample."""


class Verdict(NamedTuple):
    """overshoot: %. settling: s. rms_still: N. peak_over_force, peak_over_bound: ratios to f_d and
    to the bound I7. lost: ms without contact on the still surface.
    """

    unstable: bool
    overshoot: float
    settling: float
    rms_still: float
    peak_over_force: float
    peak_over_bound: float
    lost: int


def verdict(family: Family, rng: np.random.Generator) -> Verdict:
    """Draw a reference force and a plant, close the loop, judge it."""
    force = rng.uniform(3.0, 12.0)
    rig = draw_rig(family, force, rng)
    reaction = _reaction(family, rig)
    bounds = draw_bounds(family, force, reaction, rng)
    rig = within_reach(rig, bounds.approach)
    reference = Reference(force)
    law = _law(family, bounds)
    trace = run(law, rig, lambda _: reference, SPAN, period=family.period, rng=rng)
    bound = peak_bound(family, rig, force, bounds)
    return judged(trace.push[trace.touch :], force, bound)


def judged(push: Array, force: float, bound: float) -> Verdict:
    """push: true force from the touch on, N at 1 kHz. force: f_d, N."""
    still = push[: SPAN.still]
    steady, late = still[-1000:], push[1000:]
    lost = np.count_nonzero(late < 0.02 * force) > LOST * len(late)
    peak = float(still.max())
    return Verdict(
        unstable=bool(steady.std() > OSCILLATING * force or lost),
        overshoot=100.0 * max(0.0, peak / force - 1.0),
        settling=settling(still, force),
        rms_still=float(np.sqrt(np.mean((steady - force) ** 2))),
        peak_over_force=peak / force,
        peak_over_bound=peak / bound,
        lost=int(np.count_nonzero(still[50:] < 0.02)),
    )


def peak_bound(family: Family, rig: SpringRig, force: float, bounds: Bounds) -> float:
    """What stiffness, speed and reaction time allow, but no less than overshoot does, N."""
    reaction = _reaction(family, rig)
    if rig.kink > 0.0:
        return 1.2 * force + max(rig.stiffness, rig.beyond) * bounds.push * reaction
    overshoot = 1.2 if family.period == 8 else 1.25
    return max(overshoot * force, CONTACT + NOISE + rig.stiffness * bounds.approach * reaction)


def _reaction(family: Family, rig: SpringRig) -> float:
    latency = 1e-3 * (rig.sensor_latency + rig.command_latency)
    return reaction_time(latency, rig.lag, 1e-3 * family.period)


def _law(family: Family, bounds: Bounds) -> Governor:
    stiffness = StiffnessSettings(softest=family.softest, stiffest=family.stiffest)
    settings = SoftSettings(stiffness=stiffness, bandwidth=family.bandwidth)
    return build("soft", settings, bounds, family.period * 1_000_000)
