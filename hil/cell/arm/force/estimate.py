"""What the control box believes pushes the TCP: a truth with the error of the box's own senses.

CB3 infers force from joint currents, the e-Series has a sensor in its flange, and a program may
have the box believe a client's `external_force_torque` instead.
"""

from typing import Final

import numpy as np

from hil.cell.arm.inputs import InputImage
from hil.cell.arm.measurement import Measurement, Tool
from hil.cell.arm.pose import ZERO3, ZERO6, Vector3, Vector6, turn, vector6

CURRENTS: Final = (1.5, 0.1)
BUILT_IN: Final = (0.3, 0.02)
"""Standard deviation of CB3's and the e-Series' estimate, N and N·m; assumed: UR states 10 N and
3.5 N of precision, which holds offsets too."""

_NOISE_CYCLES: Final = 4096
"""Length of the noise, which repeats: drawn at once, it costs nothing while nobody looks."""

GRAVITY: Final = (0.0, 0.0, 9.82)  # m/s^2, upwards: what set_gravity takes (Script Manual)


class ForceEstimate:
    """external: believe RTDE's external_force_torque. gravity: acceleration the base feels, m/s².

    at: where an external sensor measures, m in the flange's frame.
    """

    __slots__ = ("_inputs", "_measured", "_noise", "_period", "_tare", "_tool", "at", "external",
                 "gravity")  # fmt: skip

    def __init__(self, measured: Measurement, tool: Tool, inputs: InputImage, period: int) -> None:
        self._measured, self._tool, self._inputs, self._period = measured, tool, inputs, period
        self._noise = [ZERO6]
        self._tare = ZERO6
        self.external = False
        self.at: Vector3 = ZERO3
        self.gravity: Vector3 = GRAVITY

    def disturb(self, deviation: tuple[float, float], rng: np.random.Generator) -> None:
        """Make the estimate noisy: standard deviations in N and N·m."""
        scale = np.repeat(deviation, 3)
        draws = rng.standard_normal((_NOISE_CYCLES, 6)) * scale
        self._noise = [vector6(row) for row in draws.tolist()]

    @property
    def wrench(self) -> Vector6:
        """On the TCP, N and N·m, base axes, since the last `zero`."""
        return _plus(self.mean, ZERO6 if self.external else self._noise_now)

    @property
    def mean(self) -> Vector6:
        """The same without the noise of the box's own senses."""
        return _minus(self._felt(), self._tare)

    def zero(self) -> None:
        """Call what is felt now nothing (zero_ftsensor); averaged, so the tare has no noise."""
        self._tare = self._felt()

    def believe(self, external: bool, at: Vector3) -> None:
        """Use the client's sensor at `at`, m in the flange's frame, or the box's own senses."""
        self.external, self.at = external, at
        self._tare = ZERO6

    def _felt(self) -> Vector6:
        return self._from_client() if self.external else self._measured.force

    @property
    def _noise_now(self) -> Vector6:
        return self._noise[self._measured.t // self._period % len(self._noise)]

    def _from_client(self) -> Vector6:
        """The client's wrench, which is in the flange's axes, without the payload, at the TCP."""
        value = self._inputs.external_force_torque
        assert isinstance(value, tuple)  # by the recipe's type
        rotation, tool = self._measured.flange.rotation, self._tool
        force, torque = turn(rotation, value[:3]), turn(rotation, value[3:])
        at, cog, tcp = self.at, tool.centre_of_gravity, tool.pose.position
        mass, (gx, gy, gz) = tool.mass, self.gravity
        # The payload's weight pulls the sensor against `gravity`.
        lift = (mass * gx, mass * gy, mass * gz)
        held = _cross(turn(rotation, _less(cog, at)), lift)
        force_tcp = (force[0] + lift[0], force[1] + lift[1], force[2] + lift[2])
        shift = _cross(turn(rotation, _less(at, tcp)), force_tcp)
        x, y, z = (t + h + s for t, h, s in zip(torque, held, shift, strict=True))
        return (*force_tcp, x, y, z)


def _less(a: Vector3, b: Vector3) -> Vector3:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _cross(a: Vector3, b: Vector3) -> Vector3:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def _plus(a: Vector6, b: Vector6) -> Vector6:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5])


def _minus(a: Vector6, b: Vector6) -> Vector6:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3], a[4] - b[4], a[5] - b[5])
