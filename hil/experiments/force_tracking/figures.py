"""Figures of merit of one run, from the true force alone."""

from typing import NamedTuple

import numpy as np

from hil.experiments.force_tracking.trace import Array, Trace

HOLD = 3000
"""ms after the first contact in which the surface is still."""
STEADY = 1000
"""ms at the end of the hold that count as steady."""
SETTLED, SMOOTH = 0.05, 24
"""Band around f_d, and ms of the mean that must stay in it."""
ONSET = 500
"""ms after the motion's beginning that do not count as tracking."""
OSCILLATING, LOST = 0.1, 0.02
"""Unstable: a steady deviation above this share of f_d, or out of contact for more than this
share of the time from one second after the touch on."""


class Figures(NamedTuple):
    """overshoot: of f_d. settling: s. rms_static, rms_tracking, peak: N; None where the run ended
    before it could be told. unstable: it oscillated, bounced, or was stopped.
    """

    overshoot: float | None
    settling: float | None
    rms_static: float | None
    rms_tracking: float | None
    peak: float | None
    unstable: bool


def figures(trace: Trace, force: float, completed: bool) -> Figures:
    """Of a run at f_d = force, N; completed: it came to its end and nothing stopped it."""
    push, touch = trace.push, trace.touch
    if touch is None:
        return Figures(None, None, None, None, None, unstable=not completed)
    still = push[touch : touch + HOLD]
    steady = still[HOLD - STEADY :]
    moving = push[trace.slide + ONSET :] if trace.slide is not None else push[:0]
    return Figures(
        overshoot=max(0.0, float(push[touch : touch + HOLD].max()) / force - 1.0),
        settling=settling(still, force) if len(still) == HOLD else None,
        rms_static=rms(steady - force),
        rms_tracking=rms(moving - force),
        peak=float(push.max()),
        unstable=not completed or _unstable(push[touch:], steady, force),
    )


def settling(still: Array, force: float) -> float:
    """Time from the touch after which the smoothed force stays within the band, s."""
    smooth = np.convolve(still, np.full(SMOOTH, 1.0 / SMOOTH), mode="valid")
    outside = np.flatnonzero(np.abs(smooth - force) > SETTLED * force)
    return (int(outside[-1]) + SMOOTH) * 1e-3 if len(outside) else 0.0


def rms(error: Array) -> float | None:
    return float(np.sqrt(np.mean(error**2))) if len(error) else None


def _unstable(push: Array, steady: Array, force: float) -> bool:
    late = push[1000:]
    lost = float(np.mean(late < 0.02 * force)) if len(late) else 0.0
    deviation = float(steady.std()) if len(steady) else 0.0
    return bool(deviation > OSCILLATING * force or lost > LOST)
