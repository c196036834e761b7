"""How a batch of samples becomes frames: flags, wire scale, classic pair or CAN FD."""

from collections.abc import Callable
from typing import Final, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from drivers.protocol import nrs_can
from drivers.protocol.frame import CanFrame
from drivers.protocol.nrs_sample import encode_fd
from hil.cell.errors import RigError
from hil.cell.rig.sensor import Sensor
from hil.cell.sensor.transducer import DAMAGED, SATURATED

IntArray = NDArray[np.int64]
Timed: TypeAlias = tuple[int, CanFrame]

TORQUE_DELAY: Final = 120_000
"""TORQUE leaves after FORCE's 111 to 135 bits at 1 Mbit/s, ns."""


_new = tuple.__new__
"""A NamedTuple without its own constructor, a call of Python's that costs as much again."""
_FIELD: Final = (nrs_can.COUNT_LIMIT << 1) - 1
_PLACES: Final = np.array(
    [[1, 0], [1 << 17, 0], [1 << 34, 0], [0, 1], [0, 1 << 17], [0, 1 << 34]], np.int64
)
"""Where each of six counts stands in the FORCE and in the TORQUE payload, (6, 2)."""


class Batch(NamedTuple):
    """Consecutive samples about to be sent, numbered from `first`.

    times: ns. values: tared counts, (n, 6). alarms: as Counts has them, None without any.
    still_old: so many of them are on the zero before the current one.
    """

    times: list[int]
    values: IntArray
    alarms: list[int] | None
    first: int
    still_old: int


class Framing:
    """Encodes batches for one node; raises RigError when the rig's range exceeds the wire's."""

    def __init__(self, sensor: Sensor, identifiers: nrs_can.Identifiers) -> None:
        self._ids = identifiers
        fd = sensor.frames == "fd"
        force = nrs_can.FD_FORCE_LSB if fd else nrs_can.FORCE_LSB
        torque = nrs_can.FD_TORQUE_LSB if fd else nrs_can.TORQUE_LSB
        self._limit = nrs_can.FD_COUNT_LIMIT if fd else nrs_can.COUNT_LIMIT
        self._scale = np.repeat(
            [sensor.resolution_force / force, sensor.resolution_torque / torque], 3
        )
        self._unscaled = bool(np.all(np.abs(self._scale - 1.0) < 1e-9))
        self._encode: Callable[[list[int], IntArray, list[int], int], list[Timed]] = (
            self._encode_fd if fd else self._encode_pairs
        )
        for name, full, lsb in (
            ("force", sensor.range_force, force),
            ("torque", sensor.range_torque, torque),
        ):
            if sensor.saturation * full > (self._limit - 1) * lsb:
                raise RigError(
                    f"sensor: {sensor.saturation:g} x range_{name} {full:g} exceeds the "
                    f"{(self._limit - 1) * lsb:g} that {sensor.frames} frames can carry"
                )

    def frames(self, batch: Batch, tared: tuple[bool, bool]) -> list[Timed]:
        """Frames with their emission times; tared says whether (old, current) zero is a tare."""
        values = batch.values
        wire = values if self._unscaled else np.rint(values * self._scale).astype(np.int64)
        flags = self._flags(batch, tared)
        if self._overflows(wire):
            wire, flags = self._clip(wire, flags)
        return self._encode(batch.times, wire, flags, batch.first)

    def _overflows(self, wire: IntArray) -> bool:
        return bool(len(wire)) and int(np.abs(wire).max()) >= self._limit

    def _clip(self, wire: IntArray, flags: list[int]) -> tuple[IntArray, list[int]]:
        """Counts within the wire's range; samples that were not are flagged."""
        top = self._limit - 1
        flags = [
            flag | nrs_can.SATURATED if max(map(abs, row)) > top else flag
            for flag, row in zip(flags, wire.tolist(), strict=True)
        ]
        return np.clip(wire, -top, top), flags

    def _flags(self, batch: Batch, tared: tuple[bool, bool]) -> list[int]:
        old, new = (nrs_can.VALID | (nrs_can.TARED if zero else 0) for zero in tared)
        flags = [old] * batch.still_old + [new] * (len(batch.times) - batch.still_old)
        if batch.alarms is None:
            return flags
        return [_alarmed(flag, alarm) for flag, alarm in zip(flags, batch.alarms, strict=True)]

    def _encode_pairs(
        self, times: list[int], wire: IntArray, flags: list[int], first: int
    ) -> list[Timed]:
        """As `encode_pair` packs each sample, all of them in one go."""
        fields = (wire & _FIELD) @ _PLACES  # (n, 2)
        tails = [flag << 51 | (first + i & 0xFF) << 56 for i, flag in enumerate(flags)]
        words = fields.astype(np.uint64) | np.array(tails, np.uint64)[:, np.newaxis]
        octets = words.astype("<u8", copy=False).tobytes()
        force, torque = self._ids.force, self._ids.torque
        frames: list[Timed] = []
        for at, t in zip(range(0, len(octets), 16), times, strict=True):
            frames.append((t, _new(CanFrame, (force, octets[at : at + 8], False))))
            frames.append(
                (t + TORQUE_DELAY, _new(CanFrame, (torque, octets[at + 8 : at + 16], False)))
            )
        return frames

    def _encode_fd(
        self, times: list[int], wire: IntArray, flags: list[int], first: int
    ) -> list[Timed]:
        numbered = enumerate(zip(times, wire.tolist(), flags, strict=True), first)
        return [
            (t, encode_fd(self._ids, counts, flag, counter, t // 1000))
            for counter, (t, counts, flag) in numbered
        ]


def _alarmed(flags: int, alarms: int) -> int:
    if alarms & 0x3F:
        flags |= nrs_can.OVERLOAD
    if alarms & SATURATED:
        flags |= nrs_can.SATURATED
    if alarms & DAMAGED:
        flags = (flags | nrs_can.FAULT) & ~nrs_can.VALID
    return flags
