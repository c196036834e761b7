"""Whether this host keeps time well enough to close a control loop on it."""

import os
from time import perf_counter, sleep
from typing import Final

from hil.doctor.finding import Finding, Verdict

STEP: Final = 1e-3
SPAN: Final = 2.0
"""Seconds of waking up every STEP."""


def jitter(period: float, span: float = SPAN) -> Finding:
    """Lateness of wake-ups on a fixed schedule, judged by the control period, s."""
    start, late = perf_counter(), []
    for step in range(1, round(span / STEP) + 1):
        due = start + step * STEP
        sleep(max(0.0, due - perf_counter()))
        late.append(perf_counter() - due)
    return judged(late, period)


def judged(late: list[float], period: float) -> Finding:
    """The finding for so many latenesses, s."""
    ranked = sorted(late)
    p50, p99 = (ranked[int(share * (len(ranked) - 1))] for share in (0.5, 0.99))
    worst = ranked[-1]
    found = (
        f"wakes late by {p50 * 1e6:.0f} us (p50), {p99 * 1e6:.0f} us (p99), "
        f"{worst * 1e6:.0f} us (max); a period is {period * 1e3:g} ms"
    )
    if p99 > period / 2:
        advice = "this host misses periods: stop other load, or use another machine"
        return Finding("host jitter", Verdict.FAIL, found, advice)
    if worst > period / 2:
        advice = "single periods will be late: stop other load, use a PREEMPT_RT kernel"
        return Finding("host jitter", Verdict.WARN, found, advice)
    return Finding("host jitter", Verdict.OK, found)


def priority() -> Finding:
    """Whether this user may run at real-time priority, by trying for a moment."""
    before, parameters = os.sched_getscheduler(0), os.sched_getparam(0)
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(1))
    except PermissionError:
        advice = "add '@realtime - rtprio 99' to /etc/security/limits.conf and join that group"
        return Finding("real-time priority", Verdict.WARN, "not allowed for this user", advice)
    os.sched_setscheduler(0, before, parameters)
    return Finding("real-time priority", Verdict.OK, "allowed")
