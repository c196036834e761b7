"""The five figures of a fault: noticed, answered, at rest, how hard, and ready again."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

import numpy as np

from hil.cell.faults.log import FaultEvent, Stage
from hil.trial.always import REST_SPEED, REST_TURN
from hil.trial.trace import Trace

WITHDRAW: Final = "withdraw"
"""The phase in which an arm draws back from what it met."""
NOTHING: Final[Mapping[int, float]] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class Figures:
    """Bench seconds from the fault's first effect; None for what did not happen while a job ran:
    one that simply came to its end has not been stopped.

    detection: until the near side, or the robot's program, gave up servoing. reaction: until the
    robot had its first safe command, or had stopped by itself. stop: until it stood for good, but
    for drawing back.
    exposure: largest true |f| / f_b since. over: seconds of it above 1. phase: it became active in.
    recovery: from the permission to go on until a job could begin, or from standstill until the arm
    had drawn back; None where neither was wanted or came about.
    """

    kind: str
    index: int
    active: float
    phase: str
    detection: float | None
    reaction: float | None
    stop: float | None
    exposure: float
    over: float
    recovery: float | None = None


def figures(
    trace: Trace,
    events: Iterable[FaultEvent],
    noticed: int | None,
    recovered: Mapping[int, float] = NOTHING,
    *,
    broken_off: bool = False,
) -> tuple[Figures, ...]:
    """Of each fault that was active. noticed: arm time of the near side's stop, ns. recovered: how
    long it took to be ready again, s, by the fault's index. broken_off: the job did not come to an
    end of its own; with a link that is cut it is over before the robot's next period tells so.
    """
    active = (event for event in events if event.stage is Stage.ACTIVE)
    return tuple(
        _figures(trace, event, noticed, recovered.get(event.index, _drawn_back(trace)), broken_off)
        for event in active
    )


def _drawn_back(trace: Trace) -> float | None:
    """Seconds of drawing back; None where the arm did not."""
    back = np.flatnonzero([phase == WITHDRAW for phase in trace.phases])
    moving = back[trace["speed"][back] > REST_SPEED]
    return float(trace["t"][moving[-1]] - trace["t"][back[0]]) if len(moving) else None


def _figures(
    trace: Trace,
    event: FaultEvent,
    noticed: int | None,
    recovery: float | None,
    broken_off: bool,
) -> Figures:
    t, begin = trace["t"], event.t * 1e-9
    first = int(np.searchsorted(t, begin))
    since = slice(first, None)
    force = trace["force"][since]
    stopped = trace["stopping"][since] > 0.5
    if not broken_off:  # what ends in peace comes to rest too
        stopped &= trace["running"][since] > 0.5
    reaction = _first(t[since], stopped, begin)
    seen = None if noticed is None or noticed * 1e-9 < begin else noticed * 1e-9 - begin
    known = [latency for latency in (seen, reaction) if latency is not None]
    step = float(np.median(np.diff(t))) if len(t) > 1 else 0.0
    return Figures(
        event.kind,
        event.index,
        begin,
        trace.phases[min(first, len(t) - 1)],
        min(known, default=None),
        reaction,
        None if reaction is None else _stood(trace, since, begin, reaction),
        float(force.max(initial=0.0)),
        float((force > 1.0).sum()) * step,
        recovery,
    )


def _first(t: np.ndarray, holds: np.ndarray, begin: float) -> float | None:
    at = np.flatnonzero(holds)
    return float(t[at[0]]) - begin if len(at) else None


def _stood(trace: Trace, since: slice, begin: float, reaction: float) -> float | None:
    """When the arm last moved; None where it still does at the end.

    One that stood at the time anyway stands for good from the reaction on.
    """
    moving = (trace["speed"][since] > REST_SPEED) | (trace["turning"][since] > REST_TURN)
    moving &= np.array([phase != WITHDRAW for phase in trace.phases[since]])
    at = np.flatnonzero(moving)
    if not len(at):
        return reaction
    last, t = int(at[-1]), trace["t"][since]
    return None if last + 1 >= len(t) else max(reaction, float(t[last + 1]) - begin)
