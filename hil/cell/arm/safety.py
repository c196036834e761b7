"""The safety system's judgement of a joint set-point: None, or why it makes a protective stop."""

from collections.abc import Sequence
from math import dist, isfinite
from typing import NamedTuple

from hil.cell.arm.pose import Vector3, Vector6
from hil.cell.rig.robot import Safety


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
