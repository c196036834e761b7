"""The transducer: true wrenches in, counts out, with every error of the rig's budget between."""

import math
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from hil.cell.rig.sensor import Errors, Sensor
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

    alarms: a bit per overloaded axis, SATURATED, DAMAGED, (n,).
    """

    values: IntArray
    alarms: IntArray


class Transducer:
    """One gauge bridge with its own bias, crosstalk and gain, drawn once from `rng`."""

    def __init__(self, sensor: Sensor, rng: np.random.Generator) -> None:
        errors = error_budget(sensor)
        self._rng = rng
        self._range = _per_axis(sensor.range_force, sensor.range_torque)
        self._ceiling = sensor.saturation * self._range
        self._resolution = _per_axis(sensor.resolution_force, sensor.resolution_torque)
        self._range_counts = self._range / self._resolution
        self._alert = self._range - self._resolution
        self._calibration = self._draw_calibration(errors)
        self._bias = rng.standard_normal(6) * _per_axis(errors.bias_force, errors.bias_torque)
        self._warm_up = rng.standard_normal(6) * _per_axis(
            errors.warm_up_force, errors.warm_up_torque
        )
        self._warm_up_time = errors.warm_up_time * 1e9
        step = _per_axis(errors.walk_force, errors.walk_torque) / math.sqrt(RATE)
        self._sigma = np.concatenate([_per_axis(errors.noise_force, errors.noise_torque), step])
        self._hysteresis = Hysteresis(errors.hysteresis)
        self._low_pass = LowPass(sensor.filter_cutoff, RATE)

    def _draw_calibration(self, errors: Errors) -> Array:
        """Right factor of wrench rows: gain errors on the diagonal, crosstalk beside it, (6, 6)."""
        cross = errors.crosstalk * self._rng.standard_normal((6, 6))
        np.fill_diagonal(cross, errors.gain * self._rng.standard_normal(6))
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
        self._bias = self._bias + wrench

    def measure(self, t: int, wrenches: Array) -> Counts:
        """Counts of consecutive conversions, the last one at t ns after power-up, (n, 6)."""
        n = len(wrenches)
        if n == 0:
            return Counts(np.empty((0, 6), np.int64), np.empty(0, np.int64))
        draws = self._rng.standard_normal((n, 12)) * self._sigma
        walk = np.add.accumulate(draws[:, 6:])
        zero = self._bias - self._warm_up * math.expm1(-t / self._warm_up_time)
        self._bias = self._bias + walk[-1]
        signal = self._hysteresis.follow(wrenches) @ self._calibration
        signal += walk
        signal += draws[:, :6]
        signal += zero
        clipped = np.minimum(np.maximum(signal, -self._ceiling), self._ceiling)
        values = np.rint(self._low_pass.filter(clipped) / self._resolution).astype(np.int64)
        return Counts(values, self._alarms(wrenches, signal, values))

    def _alarms(self, wrenches: Array, signal: Array, values: IntArray) -> IntArray:
        alarms = np.zeros(len(values), np.int64)
        if self._low_pass.cutoff == 0.0 and not np.count_nonzero(np.abs(signal) > self._alert):
            return alarms
        overloaded = np.abs(values) > self._range_counts
        clipped = np.abs(signal) >= self._ceiling
        alarms |= overloaded @ AXIS_BITS
        alarms |= np.where(clipped.any(axis=1), SATURATED, 0)
        alarms |= np.where((np.abs(wrenches) > DAMAGE * self._range).any(axis=1), DAMAGED, 0)
        return alarms
