"""The transducer and its node, with their faults."""

from typing import Final

import numpy as np

from hil.cell.faults.injector import Running
from hil.cell.injection.injection import Injection
from hil.cell.rig.sensor import Sensor
from hil.cell.sensor.node import SensorNode
from hil.cell.sensor.transducer import DAMAGED, RATE, SATURATED, Array, Counts, IntArray, Transducer

NS: Final = 1_000_000_000
AXES: Final = ("fx", "fy", "fz", "tx", "ty", "tz")
_SWAP: Final = (1, 0, 2, 4, 3, 5)


class InjectedTransducer(Transducer):
    """Wrong wrenches come in (S5), wrong counts go out (S1 to S4, S6)."""

    def __init__(self, sensor: Sensor, rng: np.random.Generator, injection: Injection) -> None:
        super().__init__(sensor, rng)
        self._injection = injection
        force, torque = sensor.resolution_force, sensor.resolution_torque
        self._lsb = np.array([force] * 3 + [torque] * 3)
        self._stuck: dict[int, IntArray] = {}

    def measure(self, t: int, wrenches: Array) -> Counts:
        for one in self._injection.of("S5"):
            wrenches = _rearranged(one, wrenches)
            one.felt(t, f"axes: {one.fault.word('what')}")
        counts = super().measure(t, wrenches)
        if not len(counts.values):
            return counts
        for kind, act in (
            ("S1", self._bias_off), ("S2", self._noisy), ("S4", self._clipped), ("S3", self._held),
            ("S6", self._flagged),
        ):  # fmt: skip
            for one in self._injection.of(kind):
                changed = act(one, t, counts)
                if changed is not counts:
                    one.felt(t, kind)
                counts = changed
        return counts

    def _bias_off(self, one: Running, t: int, counts: Counts) -> Counts:
        axis = AXES.index(one.fault.word("axis"))
        size = one.fault.number("force") if axis < 3 else one.fault.number("torque")
        drift = one.fault.number("drift") * (t - one.since) / NS if axis < 3 else 0.0
        values = counts.values.copy()
        values[:, axis] += round((size + drift) / self._lsb[axis])
        return counts._replace(values=values)

    def _noisy(self, one: Running, t: int, counts: Counts) -> Counts:
        rng, fault = one.draws(t), one.fault
        n = len(counts.values)
        sigma = np.array([fault.number("force")] * 3 + [fault.number("torque")] * 3)
        noise = rng.standard_normal((n, 6)) * sigma
        struck = rng.random(n) < fault.number("spike_rate") / RATE
        noise[:, :3] += np.where(struck[:, None], fault.number("spike"), 0.0)
        return counts._replace(values=counts.values + np.rint(noise / self._lsb).astype(np.int64))

    def _clipped(self, one: Running, t: int, counts: Counts) -> Counts:
        fault = one.fault
        top = np.array([fault.number("force")] * 3 + [fault.number("torque")] * 3) / self._lsb
        beyond = (np.abs(counts.values) > top).any(axis=1)
        if not beyond.any():
            return counts
        values = np.rint(np.clip(counts.values, -top, top)).astype(np.int64)
        return Counts(values, _alarms(counts) | np.where(beyond, SATURATED, 0))

    def _held(self, one: Running, t: int, counts: Counts) -> Counts:
        row = self._stuck.setdefault(one.index, counts.values[0].copy())
        return Counts(np.tile(row, (len(counts.values), 1)), None)

    def _flagged(self, one: Running, t: int, counts: Counts) -> Counts:
        bit = one.fault.word("bit")
        if bit == "watchdog":
            return counts
        axis = AXES.index(one.fault.word("axis"))
        return counts._replace(
            alarms=_alarms(counts) | (1 << axis if bit == "overload" else DAMAGED)
        )


class NodeRestart:
    """S6 `watchdog`: the node's own watchdog restarts it once."""

    def __init__(self, injection: Injection, node: SensorNode) -> None:
        self._injection, self._node = injection, node

    def before(self, t: int) -> None:
        for one in self._injection.of("S6"):
            if one.fault.word("bit") == "watchdog":
                self._node.reboot(t)
                one.done(t, "node restarts")

    def after(self, t: int) -> None:
        """A stuck value is forgotten with its fault."""


def _alarms(counts: Counts) -> IntArray:
    if counts.alarms is None:
        return np.zeros(len(counts.values), np.int64)
    return counts.alarms


def _rearranged(one: Running, wrenches: Array) -> Array:
    what = one.fault.word("what")
    if what == "swap":
        return wrenches[:, _SWAP]
    factor = -1.0 if what == "sign" else one.fault.number("scale")
    scaled: Array = wrenches * factor
    return scaled
