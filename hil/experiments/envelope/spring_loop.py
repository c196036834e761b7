"""A force law against the spring plant, in one process and without wires."""

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np

from controller.laws.interface import AxisLaw, AxisReading, Reference
from hil.experiments.envelope.spring_plant import UNTOUCHED, Array, SpringRig, advance

START = 0.193
"""The paper's x_c(0), m."""
MS = 1_000_000

Spoil: TypeAlias = Callable[[AxisReading], AxisReading]
Wanted: TypeAlias = Callable[[float], Reference]


class Trace(NamedTuple):
    """1 kHz: true push (N) and position (m). Per period: commands (m). touch: index, or -1."""

    push: Array
    position: Array
    commands: Array
    touch: int


class Span(NamedTuple):
    """Longest approach, then the surface still, then passing under the tool: ms."""

    approach: int = 4000
    still: int = 3000
    moving: int = 0


def run(
    law: AxisLaw,
    rig: SpringRig,
    wanted: Wanted,
    span: Span,
    *,
    period: int,
    rng: np.random.Generator,
    spoil: Spoil | None = None,
) -> Trace:
    """Approach, press, follow; ends at the span's end or when no touch came in time.

    wanted: the reference at a time since the start, s. period: ms. spoil: changes what the law is
    told, for drop-outs and lies.
    """
    length = span.approach + span.still + span.moving + period
    numbers = rig.numbers(period, span.still, START - rig.gap)
    state = np.array([START + rig.standing, START, START, 0.0, 0.0, UNTOUCHED, 0.0, 0.0])
    sent = np.zeros(length // period + 2)
    dice = rng.standard_normal((length, 3))
    out = np.empty((length, 3))
    law.reset(START)
    command, begin = START, 0
    for count, end in enumerate(range(1, length, period)):
        advance(numbers, state, sent, count, dice, begin, end, out)
        reading = _reading(rig, out, dice, end - 1, period)
        command += law.step(spoil(reading) if spoil else reading, wanted((end - 1) * 1e-3))
        sent[count] = command
        begin = end
        if _over(state[5], end, span):
            break
    return Trace(out[:begin, 0], out[:begin, 1], sent[: count + 1], int(state[5]))


def _over(touch: float, now: int, span: Span) -> bool:
    if touch < 0.0:
        return now > span.approach
    return now - touch >= span.still + span.moving


def _reading(rig: SpringRig, out: Array, dice: Array, now: int, period: int) -> AxisReading:
    """Force and position as old as the sensor's latency; nothing before the first came."""
    newest = now - rig.sensor_latency
    push = tuple(out[max(0, newest - period + 1) : max(0, newest + 1), 2].tolist())
    if newest < 0:
        return AxisReading(now * MS, push, None)
    return AxisReading(now * MS, push, float(out[newest, 1] + rig.pose_noise * dice[newest, 2]))
