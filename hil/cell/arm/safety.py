"""The safety system's judgement of a joint set-point: None, or why it makes a protective stop."""

from collections.abc import Sequence
from math import dist, hypot, isfinite
from typing import Final, NamedTuple

from hil.cell.arm.pose import Vector3, Vector6
from hil.cell.rig.robot import Safety

_GROWN: Final = 1.1
"""How much a force grows before a stop follows a stop; assumed."""


class Motion(NamedTuple):
    """One cycle's motion: joint angles, rad, and TCP position in the base, m, before and after."""

    q: Vector6
    next_q: Vector6
    tcp: Vector3
    next_tcp: Vector3
    seconds: float


def judge(motion: Motion, limits: Safety) -> str | None:
    """Why `motion` is refused, with what was found and what is allowed.

    The order is that of severity: a jump is also too fast, and is told as a jump.
    """
    step = max(map(abs, map(float.__sub__, motion.next_q, motion.q)))
    outside = out_of_range(motion.next_q, limits)
    if outside is not None and not _comes_back(motion, limits):
        return outside
    if step > limits.servo_step:
        return _exceeded("set-point jump", step, limits.servo_step, "rad")
    speed = step / motion.seconds
    if speed > limits.joint_speed:
        return _exceeded("joint speed", speed, limits.joint_speed, "rad/s")
    tcp_speed = dist(motion.tcp, motion.next_tcp) / motion.seconds
    if tcp_speed > limits.tcp_speed:
        return _exceeded("TCP speed", tcp_speed, limits.tcp_speed, "m/s")
    return None


def out_of_range(q: Sequence[float], limits: Safety) -> str | None:
    """Why the arm may not stand at these joint angles, rad."""
    if not isfinite(sum(q)):
        return f"set-point is not finite: {tuple(q)}"
    farthest = max(map(abs, q))
    if farthest > limits.joint_range:
        return _exceeded("joint position", farthest, limits.joint_range, "rad")
    return None


class ForceGuard:
    """Trips where the tool presses too hard; then again only if it presses harder still.

    An arm that was stopped in contact stays there, and must be allowed to drive away.
    """

    __slots__ = ("_allowed", "_limit")

    def __init__(self, limit: float) -> None:
        """limit: N."""
        self._allowed = self._limit = limit

    def judge(self, wrench: Vector6) -> str | None:
        """Why this wrench on the TCP, N and N·m, makes a protective stop."""
        force = hypot(*wrench[:3])
        if force <= self._limit:
            self._allowed = self._limit
        if force <= self._allowed:
            return None
        self._allowed = _GROWN * force
        return _exceeded("TCP force", force, self._limit, "N")


def _comes_back(motion: Motion, limits: Safety) -> bool:
    """Whether every joint beyond its range moves inwards.

    An arm that braked from speed stands a little outside; a box lets it be driven back.
    """
    pairs = zip(motion.q, motion.next_q, strict=True)
    return all(
        abs(after) <= limits.joint_range or abs(after) < abs(before) for before, after in pairs
    )


def _exceeded(what: str, found: float, allowed: float, unit: str) -> str:
    return f"{what} {found:.4g} {unit}, allowed is {allowed:.4g} {unit}"
