"""Whether the sensor feels the tool along the axes along which the arm shakes it.

A tool that is shaken pushes on its sensor with mass times acceleration, whatever the sensor's zero
and however the tool hangs. All axes are shaken at once, each at a frequency of its own, and pose
and force are compared at each frequency: a swapped axis answers at another's, a wrong sign in the
other direction, a wrong scale with another mass.
"""

from cmath import exp
from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, dist, tau
from statistics import fmean
from typing import Final, NamedTuple, TypeAlias

from controller.frames import turned
from drivers.errors import RobotStateError, SensorAxesError
from drivers.interfaces import Arm, ForceTorqueSensor, Vector6

Vector3: TypeAlias = tuple[float, float, float]

WINDOW: Final = 0.4
"""s that are compared, and as long before them for the arm to swing in."""
CYCLES: Final = (2, 3, 4)
"""Of x, y and z in a window: whole ones, so that no axis and no zero shows at another's frequency.
5 to 10 Hz: an arm follows them, and 20 ms of delay between pose and force are no change of sign.
"""
ACCELERATION: Final = 1.0
"""m/s^2, of each axis: 1 mm at 5 Hz, and ten times the noise of a mean with 0.6 kg."""
STILL: Final = 0.1
"""s of standing still first, in which the sensor must already say something usable."""
PUSH: Final = 5.0
"""N by which the force may change meanwhile; more is no tool that hangs free."""
_AXES: Final = "xyz"


@dataclass(frozen=True, slots=True)
class Load:
    """What hangs below the sensor, kg, and the share of it by which a felt mass may be off.

    Gain, crosstalk and filter of a sound sensor come to a few hundredths.
    """

    mass: float
    error: float = 0.2


class Row(NamedTuple):
    """One period: s since the shaking began; TCP, m, and force, N, both in the base frame."""

    t: float
    position: Vector3
    force: Vector3


def self_test(arm: Arm, sensor: ForceTorqueSensor, load: Load) -> None:
    """Shake the tool by a millimetre where it hangs.

    Enters and leaves with one command in flight. Raises SensorAxesError, RobotStateError for an arm
    that does not follow, and what the drivers raise. Moments are not tested.
    """
    rows = _shaken(arm, sensor)
    for axis, cycles in enumerate(CYCLES):
        omega = tau * cycles / WINDOW
        way = _component(rows, [row.position[axis] for row in rows], omega)
        _judge_way(abs(way), _amplitude(omega), _AXES[axis])
        for other in range(3):
            push = _component(rows, [row.force[other] for row in rows], omega)
            _judge_mass(push / (way * omega**2), load, (_AXES[axis], _AXES[other]))


def _judge_way(way: float, told: float, axis: str) -> None:
    if way < 0.5 * told:
        raise RobotStateError(
            f"self test: the arm moved {way * 1e3:.2g} mm along {axis} of its base, "
            f"was told {told * 1e3:.2g} mm"
        )


def _judge_mass(felt: complex, load: Load, axes: tuple[str, str]) -> None:
    """felt: mass that answers, kg; its phase is the delay between pose and force."""
    shaken, pushed = axes
    expected = load.mass if shaken == pushed else 0.0
    backwards = expected > 0.0 and felt.real < 0.0
    if backwards or abs(abs(felt) - expected) > load.error * load.mass:
        raise SensorAxesError(
            f"self test: shaken along {shaken} of the base, the tool pushed along {pushed} like "
            f"{-abs(felt) if felt.real < 0.0 else abs(felt):.2g} kg, expected {expected:.2g} kg; "
            "check the sensor's axes, signs and scale, and tool.mass"
        )


def _shaken(arm: Arm, sensor: ForceTorqueSensor) -> list[Row]:
    """Pose and force of each period of the window, the arm back where it was."""
    state = arm.read()
    origin, begin = state.pose, state.t * 1e-9 + STILL
    rows: list[Row] = []
    first: Vector3 | None = None
    while True:
        t = state.t * 1e-9 - begin
        force = turned(_mean(sensor, state.t), state.pose)
        first = first or force
        if dist(force, first) > PUSH:
            raise SensorAxesError(
                f"self test: the force changed by {dist(force, first):.3g} N, allowed are "
                f"{PUSH:g} N; does the tool touch anything?"
            )
        if t > 2 * WINDOW:
            arm.servo(origin)
            return rows
        if t > WINDOW:
            rows.append(Row(t, state.pose[:3], force))
        arm.servo(_offset(origin, max(0.0, t)))
        state = arm.read()


def _mean(sensor: ForceTorqueSensor, t: int) -> Vector3:
    """Mean force of the samples since the last read, sensor frame, N."""
    reading = sensor.read(t)
    samples = reading.samples or (reading.wrench,)
    x, y, z = (sum(sample[axis] for sample in samples) / len(samples) for axis in range(3))
    return x, y, z


def _offset(origin: Vector6, t: float) -> Vector6:
    """Where the tool shall be t s after the shaking began: it begins and ends at rest, and does not
    go below where it was.
    """
    x, y, z = (
        at + _amplitude(omega) * (1.0 - cos(omega * t))
        for at, omega in zip(origin[:3], (tau * cycles / WINDOW for cycles in CYCLES), strict=True)
    )
    return (x, y, z, *origin[3:])


def _amplitude(omega: float) -> float:
    return ACCELERATION / omega**2


def _component(rows: Sequence[Row], values: Sequence[float], omega: float) -> complex:
    """Complex amplitude of the values about their mean at omega, rad/s."""
    middle = fmean(values)
    turning = (exp(-1j * omega * row.t) for row in rows)
    total = sum((value - middle) * turn for value, turn in zip(values, turning, strict=True))
    return 2.0 / len(rows) * total
