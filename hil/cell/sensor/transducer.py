"""The transducer: true wrenches in, counts out, with every error of the rig's budget between."""

import math
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from hil.cell.rig.sensor import Errors, Sensor
from hil.cell.sensor.disturbance import Disturbance
from hil.cell.sensor.hysteresis import Hysteresis
from hil.cell.sensor.lowpass import LowPass

Array = NDArray[np.float64]
IntArray = NDArray[np.int64]

RATE: Final = 1000
"""Conversions per second of the sensor's clock."""
SATURATED: Final = 1 << 6
DAMAGED: Final = 1 << 7
AXIS_BITS: Final = 1 << np.arange(6)
DAMAGE: Final = 3.0
"""Multiple of the range at which a gauge yields, typical of strain-gauge sensors."""


def _per_axis(force: float, torque: float) -> Array:
    return np.array([force] * 3 + [torque] * 3)


def error_budget(sensor: Sensor) -> Errors:
    """The rig's errors, or none but quantisation for the quiet preset."""
    if sensor.preset != "nrs-6050-d80-quiet":
        return sensor.errors
    sizes = set(Errors.model_fields) - {"warm_up_time"}
    return sensor.errors.model_copy(update=dict.fromkeys(sizes, 0.0))


class Counts(NamedTuple):
    """values: untared, in the sensor's resolution, (n, 6).

    alarms: a bit per overloaded axis, SATURATED, DAMAGED, (n,); None when nobody looked, because
    no gauge was near its range.
    """

    values: IntArray
    alarms: IntArray | None


class Transducer:
    """One gauge bridge with its own bias, crosstalk and gain, drawn once from `rng`.

    Everything behind the gauges is linear, so it is reckoned in counts of the resolution.
    """

    def __init__(self, sensor: Sensor, rng: np.random.Generator) -> None:
        errors = error_budget(sensor)
        self._resolution = _per_axis(sensor.resolution_force, sensor.resolution_torque)
        self._range = _per_axis(sensor.range_force, sensor.range_torque)
        self._range_counts = self._range / self._resolution
        self._watched = self._range_counts - 1.0
        self._ceiling = sensor.saturation * self._range_counts
        self._calibration = self._draw_calibration(errors, rng) / self._resolution
        bias = _per_axis(errors.bias_force, errors.bias_torque) / self._resolution
        self._bias = rng.standard_normal(6) * bias
        warm_up = _per_axis(errors.warm_up_force, errors.warm_up_torque) / self._resolution
        self._warm_up = rng.standard_normal(6) * warm_up
        self._warm_up_time = errors.warm_up_time * 1e9
        noise = _per_axis(errors.noise_force, errors.noise_torque) / self._resolution
        step = _per_axis(errors.walk_force, errors.walk_torque) / self._resolution
        self._disturbance = Disturbance(noise, step / math.sqrt(RATE), rng)
        self._hysteresis = Hysteresis(errors.hysteresis)
        self._low_pass = LowPass(sensor.filter_cutoff, RATE)

    def _draw_calibration(self, errors: Errors, rng: np.random.Generator) -> Array:
        """Right factor of wrench rows: gain errors on the diagonal, crosstalk beside it, (6, 6)."""
        cross = errors.crosstalk * rng.standard_normal((6, 6))
        np.fill_diagonal(cross, errors.gain * rng.standard_normal(6))
        matrix: Array = np.eye(6) + cross * self._range[:, None] / self._range[None, :]
        return matrix.T

    @property
    def cutoff(self) -> float:
        """Low-pass cut-off, Hz; 0 is off."""
        return self._low_pass.cutoff

    def set_cutoff(self, cutoff: float) -> None:
        self._low_pass = LowPass(cutoff, RATE)

    def shift_bias(self, wrench: Array) -> None:
        """Move the zero by `wrench`, as a knock or a thermal shock does; (6,)."""
        self._bias = self._bias + wrench / self._resolution

    def measure(self, t: int, wrenches: Array) -> Counts:
        """Counts of consecutive conversions, the last one at t ns after power-up, (n, 6)."""
        n = len(wrenches)
        if n == 0:
            return Counts(np.empty((0, 6), np.int64), None)
        signal = self._hysteresis.follow(wrenches) @ self._calibration
        signal += self._disturbance.take(n)
        signal += self._bias - self._warm_up * math.expm1(-t / self._warm_up_time)
        # A filter hides an overload from the values, so with one every block is looked at.
        if self._low_pass.cutoff or np.count_nonzero(np.abs(signal) > self._watched):
            return self._guarded(wrenches, signal)
        return Counts(np.rint(signal).astype(np.int64), None)

    def _guarded(self, wrenches: Array, signal: Array) -> Counts:
        """Counts of a signal that may be beyond the range: clipped, filtered, with its alarms."""
        clipped = np.minimum(np.maximum(signal, -self._ceiling), self._ceiling)
        values = np.rint(self._low_pass.filter(clipped)).astype(np.int64)
        overloaded = np.abs(values) > self._range_counts
        saturated = (np.abs(signal) >= self._ceiling).any(axis=1)
        damaged = (np.abs(wrenches) > DAMAGE * self._range).any(axis=1)
        alarms = overloaded @ AXIS_BITS
        alarms |= np.where(saturated, SATURATED, 0) | np.where(damaged, DAMAGED, 0)
        return Counts(values, alarms)
