"""Builtins that follow a set-point which programs send all the time: servoj, servoc."""

from math import dist, exp, hypot
from typing import Final

from hil.cell.arm.urscript.builtins.drive import Drive, along
from hil.cell.arm.urscript.builtins.poses import between
from hil.cell.arm.urscript.builtins.timing import cycles
from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.values import Blocking, Pose, Value, number, pose6, vector6

_CB3_PERIOD: Final = 0.008

SHORTEST, LONGEST = 0.03, 0.2
"""s, of lookahead_time (Script Manual, servoj)."""

SOFTEST, STIFFEST = 100.0, 2000.0
"""Of gain (Script Manual, servoj)."""

_GAIN: Final = 300.0  # the manual's default


class Servoing:
    """The shortest look-ahead lets the set-point through: its lag is the rig's servo bandwidth.

    A longer one is a first-order lag of (lookahead_time - 0.03 s) * 300 / gain before it. UR
    publishes no equation; this one agrees at the defaults with the delay that users report.
    """

    def __init__(self, drive: Drive) -> None:
        self._drive = drive

    def servoj(  # noqa: PLR0917  # the manual's order
        self,
        q: Value,
        a: Value = 0.0,
        v: Value = 0.0,
        t: Value = _CB3_PERIOD,
        lookahead_time: Value = 0.1,
        gain: Value = _GAIN,
    ) -> Blocking:
        """Be at q (rad) after t (s), in equal steps when that is several cycles."""
        drive, goal = self._drive, vector6(q)
        share = _share(drive.period, number(lookahead_time), number(gain))
        count = cycles(drive.port, number(t))
        start = drive.port.target_q()
        for i in range(1, count + 1):
            wanted = goal if i == count else along(start, goal, i / count)
            drive.to(wanted if share == 1.0 else along(drive.port.target_q(), wanted, share))
            yield

    def servoc(self, pose: Value, a: Value = 1.2, v: Value = 0.25, r: Value = 0.0) -> Blocking:
        """Approach a pose at v (m/s), speeding up at a (m/s^2), until r (m) is left; no stop."""
        drive = self._drive
        goal = pose6(pose) if isinstance(pose, Pose) else drive.forward(vector6(pose))
        if not (number(a) > 0.0 and number(v) > 0.0):
            raise ScriptError(f"speed {number(v)} and acceleration {number(a)} must be above 0")
        drive.waypoint = goal
        speed = hypot(*drive.port.target_tcp_speed()[:3])
        while True:
            here = drive.port.target_tcp_pose()
            speed = min(number(v), speed + number(a) * drive.period)
            step, left = speed * drive.period, dist(here[:3], goal[:3])
            near = left <= max(step, number(r))
            drive.to(
                drive.inverse(goal if left <= step else between(here, goal, step / left), None)
            )
            yield
            if near:
                return


def _share(period: float, lookahead: float, gain: float) -> float:
    """Part of the way to the set-point that the filter lets through in a period."""
    lag = min(max(lookahead, SHORTEST), LONGEST) - SHORTEST
    lag *= _GAIN / min(max(gain, SOFTEST), STIFFEST)
    return 1.0 if lag <= 0.0 else 1.0 - exp(-period / lag)
