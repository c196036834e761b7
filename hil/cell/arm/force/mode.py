"""Force mode: axes of a task frame that give way until the arm presses as it is told.

UR publishes no equations. This is an admittance: force turns into motion of the position target.
Per compliant axis, M dv/dt = gain * (wanted + felt) - D v with D = D0 + damping * D1: in free space
the arm moves at force / D, against a spring k the force settles with the time constant D / k.
D0 is as small as a wall of 50 N/mm allows behind a 22 Hz servo and two control periods of delay; an
arm that touches nothing loses most of it within a second, so that it does not creep through the air
for as long as a stiff contact has to take.
"""

from dataclasses import dataclass
from math import exp, isfinite
from typing import Final, TypeAlias

from hil.cell.arm.force.frame import FIXED, KINDS, task_axes
from hil.cell.arm.pose import (
    ZERO6,
    Pose,
    Rotation,
    Vector3,
    Vector6,
    product,
    rotation_of,
    rotation_vector,
    shifted,
    transpose,
    turn,
)  # fmt: skip

Selection: TypeAlias = tuple[bool, bool, bool, bool, bool, bool]

DAMPING: Final = 0.005  # Script Manual, force_mode_set_damping: default
GAIN: Final = 1.0  # Script Manual, force_mode_set_gain_scaling: default

_D0: Final = (2000.0, 20.0)  # N·s/m and N·m·s/rad, for translations and rotations
_D1: Final = (18000.0, 180.0)  # full damping is ten times as slow
_MASS: Final = (10.0, 0.1)  # kg and kg·m²: 5 ms to speed up
_IN_AIR: Final = 0.125  # part of D0 that is left far from contact
_FORGETS: Final = 0.4  # s: how fast D0 falls to it
_TOUCH: Final = 1.0  # N that make a contact

FREEDRIVE_BAND: Final = (5.0, 5.0, 5.0, 0.5, 0.5, 0.5)
"""N and N·m that freedrive takes for friction and not for a hand; assumed."""

_FREE: Final = (0.25, 0.25, 0.25, 1.0, 1.0, 1.0)
"""m/s and rad/s that freedrive follows at most; assumed."""


@dataclass(frozen=True, slots=True)
class Task:
    """frame: base. wrench: that the arm shall apply, N and N·m. limits: for compliant axes speed,
    m/s and rad/s; for the others deviation of the TCP from its target, m and rad. band: N and N·m
    that are not felt.
    """

    frame: Pose
    selection: Selection
    wrench: Vector6
    kind: int
    limits: Vector6
    band: Vector6 = ZERO6

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise ValueError(f"force mode type {self.kind} is none of {KINDS}")
        if not all(isfinite(limit) and limit >= 0.0 for limit in self.limits):
            raise ValueError(f"force mode limits must be finite and not negative: {self.limits}")


class ForceMode:
    """task: None while the mode is off. freedrive: the mode serves a hand, not a program."""

    __slots__ = ("_axes", "_contact", "_dt", "_forgets", "_velocity", "damping", "freedrive",
                 "gain", "task")  # fmt: skip

    def __init__(self, dt: float) -> None:
        self._dt = dt
        self._forgets = exp(-dt / _FORGETS)
        self.task: Task | None = None
        self.reset()

    def reset(self) -> None:
        """Off, with the parameters that a program finds when it starts."""
        self.damping, self.gain = DAMPING, GAIN
        self.end()

    def tune(self, *, damping: float | None = None, gain: float | None = None) -> None:
        """damping: 0..1, gain: 0..2 (Script Manual); beyond that they are clipped."""
        if damping is not None:
            self.damping = min(max(damping, 0.0), 1.0)
        if gain is not None:
            self.gain = min(max(gain, 0.0), 2.0)

    def start(self, task: Task) -> None:
        """Enter the mode, or change its task in motion: programs call force_mode every cycle."""
        self.task, self.freedrive = task, False

    def release(self, frame: Pose, free: Selection) -> None:
        """Freedrive: the free axes of `frame` follow whatever pushes the tool."""
        self.task = Task(frame, free, ZERO6, FIXED, _FREE, FREEDRIVE_BAND)
        self.freedrive = True

    def end(self) -> None:
        """Hold position on all axes."""
        self.task, self.freedrive = None, False
        self._velocity: list[float] = [0.0] * 6
        self._contact = 1.0

    def notice(self, push: float) -> None:
        """Once a cycle: `push`, N, is what truly acts on the tool."""
        self._contact = 1.0 if push > _TOUCH else self._contact * self._forgets

    def step(self, at: Pose, wanted: Pose, felt: Vector6, velocity: Vector3) -> tuple[Pose, Pose]:
        """The next TCP target, and what it would be if the compliant axes stood still.

        at: the last target. wanted: the program's. felt: wrench on the TCP, N and N·m. velocity:
        of the TCP, m/s. All in the base frame.
        """
        task = self.task
        assert task is not None
        axes = task_axes(task.kind, task.frame, at.position, velocity)
        asked = _difference(axes, at, wanted)
        path = [0.0 if free else step for free, step in zip(task.selection, asked, strict=True)]
        felt_task = turn(axes, felt[:3]) + turn(axes, felt[3:])
        moved = [p + v * self._dt for p, v in zip(path, self._give(task, felt_task), strict=True)]
        return _moved(axes, at, moved), _moved(axes, at, path) if any(path) else at

    def deviation(self, target: Pose, actual: Pose) -> str | None:
        """Why the mode ends: an axis that is not compliant is too far from its target."""
        task = self.task
        assert task is not None
        error = _difference(transpose(task.frame.rotation), target, actual)
        for i, (free, limit) in enumerate(zip(task.selection, task.limits, strict=True)):
            if not free and abs(error[i]) > limit and not self.freedrive:
                return (
                    f"force mode: axis {i} is {abs(error[i]):.4g} {'m' if i < 3 else 'rad'} from "
                    f"its target, allowed is {limit:.4g}"
                )
        return None

    def _give(self, task: Task, felt: Vector6) -> list[float]:
        """Velocity of the compliant axes in this cycle, m/s and rad/s."""
        drag = self._drag()
        # Exact for a constant force over one period.
        inertia = [exp(-self._dt * d / m) for d, m in zip(drag, _MASS, strict=True)]
        for i, free in enumerate(task.selection):
            kind = i // 3
            rest = self.gain * _beyond(task.wrench[i] + felt[i], task.band[i]) / drag[kind]
            v = rest + (self._velocity[i] - rest) * inertia[kind] if free else 0.0
            self._velocity[i] = min(max(v, -task.limits[i]), task.limits[i]) if free else 0.0
        return self._velocity

    def _drag(self) -> list[float]:
        """D for translations and rotations, N·s/m and N·m·s/rad."""
        part = _IN_AIR + (1.0 - _IN_AIR) * self._contact
        return [part * d0 + self.damping * d1 for d0, d1 in zip(_D0, _D1, strict=True)]


def _beyond(force: float, band: float) -> float:
    return force - band if force > band else force + band if force < -band else 0.0


def _difference(axes: Rotation, start: Pose, end: Pose) -> Vector6:
    """From pose to pose along and about `axes`, m and rad."""
    (x0, y0, z0), (x1, y1, z1) = start.position, end.position
    turned = rotation_vector(product(end.rotation, transpose(start.rotation)))
    return turn(axes, (x1 - x0, y1 - y0, z1 - z0)) + turn(axes, turned)


def _moved(axes: Rotation, start: Pose, way: list[float]) -> Pose:
    """`start`, moved along and turned about `axes` by `way`, m and rad."""
    back = transpose(axes)
    x, y, z, rx, ry, rz = way
    turned = product(rotation_of(*turn(back, (rx, ry, rz))), start.rotation)
    return shifted(Pose(start.position, turned), turn(back, (x, y, z)))
