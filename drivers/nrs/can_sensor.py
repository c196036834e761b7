"""The force/torque sensor on CAN, as drivers.interfaces.ForceTorqueSensor."""

from collections.abc import Iterable, Sequence
from functools import partial
from typing import Final

import can

from drivers.errors import BusFaultError
from drivers.interfaces import SensorHealth, WrenchReading
from drivers.nrs.bus import open_bus
from drivers.nrs.confinement import Confinement
from drivers.nrs.link import Link
from drivers.nrs.plausibility import TYPICAL, Plausible
from drivers.nrs.session import Heard, Session
from drivers.protocol.bus_address import BusAddress
from drivers.protocol.can_error import decode_error

SILENCE: Final = 1_000_000_000
"""A node sends ten heartbeats a second; after this long without any frame the bus is reopened."""


class CanSensor:
    """Takes the bus in the caller's thread, so that lockstep runs repeat, unless `background`.

    max_age_ns: limit on the newest sample's age in arm time. period_ns: time between samples.
    bitrate: bit/s, for adapters that the driver sets up; the kernel's interfaces have theirs.
    context: section of python-can's own configuration, where the interface is `config`.
    """

    def __init__(
        self,
        interface: str,
        channel: str,
        node: int = 1,
        fd: bool = False,
        *,
        max_age_ns: int = 10_000_000,
        period_ns: int = 1_000_000,
        background: bool = False,
        plausible: Plausible = TYPICAL,
        bitrate: int | None = None,
        context: str | None = None,
    ) -> None:
        address = BusAddress(interface, channel)
        self._link = Link(partial(open_bus, address, fd, bitrate, context), background)
        self._session = Session(node, fd, period_ns, max_age_ns, plausible)
        self._heard: int | None = None
        self._last_error = ""
        self._foreign = 0
        self._confinement = Confinement()
        self._openings = 0

    def connect(self) -> None:
        """Open the bus; raises LinkError."""
        self._link.open()

    def close(self) -> None:
        self._link.close()

    def start(self) -> None:
        """Ask the node to transmit; also the way back from SensorResetError, tare and all."""
        self._session.start()
        self._heard = None

    @property
    def ready(self) -> bool:
        return self._session.ready

    def begin_tare(self, samples: int) -> None:
        """Ask the node to zero itself on the mean of so many samples; ValueError for none."""
        self._session.begin_tare(samples)

    @property
    def tare_pending(self) -> bool:
        return self._session.tare_pending

    def poll(self, t: int) -> None:
        """Take what the bus holds at arm time t; raises LinkError, CommandRefusedError."""
        messages = self._link.take()
        self._session.take(self._standard(messages), t)
        self._mind_bus(messages)
        self._mind_silence(t, heard=bool(messages))
        request = self._session.due(t)
        if request is not None:
            self._link.send(request)

    def _standard(self, messages: list[can.Message]) -> list[Heard]:
        """The frames among them; an extended 0x181 is not 0x181, and is counted as foreign."""
        frames = [
            (message.arbitration_id, bytes(message.data), message.is_fd)
            for message in messages
            if not (message.is_extended_id or message.is_remote_frame or message.is_error_frame)
        ]
        if len(frames) != len(messages):
            self._foreign += len(messages) - len(frames)
            self._hear_errors(message for message in messages if message.is_error_frame)
        return frames

    def _hear_errors(self, messages: Iterable[can.Message]) -> None:
        for message in messages:
            error = decode_error(message.arbitration_id, bytes(message.data))
            self._confinement.hear(error)
            self._last_error = error.text

    def read(self, t: int) -> WrenchReading:
        """Poll, then the newest wrench; raises what poll raises, and SensorError for no wrench."""
        self.poll(t)
        if self._confinement.owed:
            self._session.discard()
            raise BusFaultError(self._confinement.fault)
        return self._session.reading(t)

    @property
    def health(self) -> SensorHealth:
        """Counts since construction."""
        session, assembler = self._session, self._session.assembler
        errors = (self._last_error, session.last_error, assembler.last_error, self._link.last_error)
        return SensorHealth(
            pairs=assembler.pairs,
            gaps=assembler.gaps,
            duplicates=assembler.duplicates,
            torn=assembler.torn,
            malformed=assembler.malformed,
            foreign=session.foreign + self._foreign,
            receiver_alive=self._link.alive,
            last_error=next((error for error in errors if error), ""),
            bus=self._confinement.state,
        )

    def _mind_bus(self, messages: Sequence[can.Message]) -> None:
        """Count towards the end of a fault what came after the batch's last error frame."""
        if self._openings != self._link.openings:
            self._openings = self._link.openings
            self._confinement.restart()
        if self._confinement.owed:
            errors = (at for at, one in enumerate(reversed(messages)) if one.is_error_frame)
            self._confinement.credit(next(errors, len(messages)))

    def _mind_silence(self, t: int, heard: bool) -> None:
        """A kernel interface that was deleted and made again stays silent until reopened."""
        if heard or self._heard is None:
            self._heard = t
        elif t - self._heard > SILENCE:
            self._heard = t
            self._link.reopen()
