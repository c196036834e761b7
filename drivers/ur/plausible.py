"""Whether a package of the arm can be true, as RTDE has neither checksum nor count of its own."""

from math import dist, isfinite
from typing import Final

from drivers.errors import ProtocolError
from drivers.ur.sample import Sample

NS: Final = 1_000_000_000
REACH: Final = 3.0
"""m: further than any UR's flange with any tool that it can carry (UR20: 1.75 m)."""
TURNS: Final = 13.0
"""rad: two turns and some more; joints go one turn each way, only a bare wrist turns endlessly."""
SPEED: Final = 5.0
"""m/s of the TCP, beyond what the safety system of any UR allows."""
TOOL: Final = 0.5
"""m by which the TCP may leap besides: a program that begins tells of another tool."""
JOINT_SPEED: Final = 7.0
"""rad/s: the fastest joint of any UR turns once a second."""
PLAY: Final = 0.02
"""rad by which joints may leap besides."""
GAP: Final = 60 * NS
"""Longest silence that a link survives; a clock further ahead is a bent one."""


def check(sample: Sample, last: Sample | None) -> None:
    """ProtocolError for a package that cannot follow the last one; what it says is not used.

    A bit that changes a value within these bounds cannot be told from the truth.
    """
    for name in ("q", "pose", "target_pose", "twist"):
        values = getattr(sample, name)
        if not all(map(isfinite, values)):
            raise ProtocolError(f"controller says {name} is {values}: six finite numbers expected")
    _within("TCP's distance (m)", dist(sample.pose[:3], (0.0, 0.0, 0.0)), REACH)
    _within("joint angle (rad)", max(map(abs, sample.q[:5])), TURNS)
    if last is not None:
        _check_progress(sample, last)


def _check_progress(sample: Sample, last: Sample) -> None:
    ahead = sample.timestamp - last.timestamp
    _within("leap of controller time (s)", ahead, GAP / NS)
    way = dist(sample.pose[:3], last.pose[:3])
    turn = max(abs(a - b) for a, b in zip(sample.q, last.q, strict=True))
    ahead = max(ahead, 0.0)
    _within("TCP's way since the last package (m)", way, TOOL + SPEED * ahead)
    _within("joint's turn since the last package (rad)", turn, PLAY + JOINT_SPEED * ahead)


def _within(quantity: str, found: float, allowed: float) -> None:
    if found > allowed:
        raise ProtocolError(
            f"controller's package: {quantity} is {found:.6g}, at most {allowed:.6g}"
        )
