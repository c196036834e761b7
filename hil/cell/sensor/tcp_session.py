"""One client of the sensor's TCP front: its commands act on the node, its stream is the node's.

Public clients show the messages; docs/sensor.md marks what they leave open and is assumed here.
"""

from typing import Final, TypeAlias

from drivers.protocol.nrs_tcp import MAX_PERIOD, Cutter, Kind, Message, encode, encode_wrench
from hil.cell.rig.sensor import Sensor
from hil.cell.sensor.framing import Batch
from hil.cell.sensor.node import REPLY_DELAY, SensorNode

Timed: TypeAlias = tuple[int, bytes]

ACCEPTED: Final = 0
REFUSED: Final = 1
"""Third byte of an acknowledgement; its meaning is not public, so clients ignore it."""
TARE_SAMPLES: Final = 50
"""Samples of a tare's mean: the command carries no count, so this one is assumed."""


class TcpSession:
    """Idle until told to stream. Rate and zero are the node's own, whoever set them.

    Raises WireError from `receive` for bytes that are not the protocol.
    """

    def __init__(self, node: SensorNode, sensor: Sensor) -> None:
        self._node = node
        self._force, self._torque = sensor.resolution_force, sensor.resolution_torque
        self._cutter = Cutter()
        self._streaming = False
        self._taring = self._tared = False
        self._out: list[Timed] = []

    @property
    def listening(self) -> bool:
        """Whether it needs the node's samples."""
        return self._streaming or self._taring

    def receive(self, octets: bytes, t: int) -> None:
        """Do what the client asks at t; acknowledgements leave with the next `publish`."""
        for message in self._cutter.feed(octets):
            accepted = self._act(message)
            if accepted is not None:
                answer = encode(message.kind, ACCEPTED if accepted else REFUSED)
                self._out.append((t + REPLY_DELAY, answer))

    def publish(self, t: int) -> list[Timed]:
        """What leaves in the node's period that ended at t, in order."""
        batch = self._node.samples
        old = batch.still_old if batch is not None and self._tared else None
        wrenches = [] if batch is None or not self._streaming else self._encoded(batch)
        if self._taring and (self._tared or not self._node.tare.busy):
            # The stream itself says which samples are on the new zero: those after this answer.
            cut = len(wrenches) if old is None else min(old, len(wrenches))
            when = wrenches[cut - 1][0] if cut else t
            answer = encode(Kind.TARE, ACCEPTED if self._tared else REFUSED)
            wrenches.insert(cut, (when, answer))
            self._taring = self._tared = False
        leaving, self._out = self._out + wrenches, []
        return leaving

    def close(self) -> None:
        """The client is gone: a zero that nobody waits for would keep others from theirs."""
        if self._taring and not self._tared:
            self._node.tare.abandon()

    def _act(self, message: Message) -> bool | None:
        """Whether the command was taken; None for one that is answered when it is done."""
        if len(message.payload) != 1:
            return False
        (value,) = message.payload
        if message.kind == Kind.TRANSMIT and value in (0, 1):
            self._streaming = bool(value)
            return True
        if message.kind == Kind.PERIOD and 1 <= value <= MAX_PERIOD:
            self._node.settings.period = value
            return True
        if message.kind == Kind.TARE and value in (0, 1) and not self._node.tare.busy:
            return self._zero(wanted=bool(value))
        return False

    def _zero(self, *, wanted: bool) -> bool | None:
        if not wanted:
            self._node.tare.clear()
            return True
        self._taring = True
        self._node.tare.begin(TARE_SAMPLES, self._note_tare)
        return None

    def _note_tare(self, _first: int) -> None:
        self._tared = True

    def _encoded(self, batch: Batch) -> list[Timed]:
        """Data messages of a batch; overload and fault have no place in the protocol."""
        force, torque = self._force, self._torque
        return [
            (
                t,
                encode_wrench(
                    (fx * force, fy * force, fz * force, tx * torque, ty * torque, tz * torque)
                ),
            )
            for t, (fx, fy, fz, tx, ty, tz) in zip(batch.times, batch.values.tolist(), strict=True)
        ]
