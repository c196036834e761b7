"""The sensor node: clock, boot, samples, commands; frames out with their times, no bus in here."""

from bisect import bisect_right
from collections.abc import Callable
from operator import itemgetter
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from drivers.protocol.frame import CanFrame
from drivers.protocol.nrs_can import Identifiers, ProtocolError
from drivers.protocol.nrs_command import Reply, decode_command, encode_reply
from drivers.protocol.nrs_status import NodeState, StatusBit
from hil.cell.rig.sensor import Sensor
from hil.cell.sensor.announcer import Announcer
from hil.cell.sensor.commands import CommandServer, Operation, Settings
from hil.cell.sensor.framing import Batch, Framing, Timed
from hil.cell.sensor.tare import Tare
from hil.cell.sensor.transducer import DAMAGED, Counts, Transducer, error_budget

Array: TypeAlias = NDArray[np.float64]

MILLISECOND: Final = 1_000_000
REPLY_DELAY: Final = 200_000
"""From command to reply, ns: firmware latency, assumed."""

# Plain integers: joining enum flags costs 3 us a piece, in every period.
ANY_GAUGE_FAULT: Final = int(StatusBit.ANY_FAULT | StatusBit.GAUGE_FAULT)
TRANSMIT_ON: Final = int(StatusBit.TRANSMIT_ON)
TARED: Final = int(StatusBit.TARED)
FILTER_ON: Final = int(StatusBit.FILTER_ON)
WARMING_UP: Final = int(StatusBit.WARMING_UP)

_emission_time = itemgetter(0)


class SensorNode:
    """One node on the bus, switched on at t = 0; same seed and inputs give the same frames.

    samples: those of the last `advance`, for fronts beside the bus, which set `listened` to have
    them while nobody asked for frames. boots: how often the node has started.
    """

    def __init__(
        self,
        sensor: Sensor,
        rng: np.random.Generator,
        build: Callable[[Sensor, np.random.Generator], Transducer] = Transducer,
    ) -> None:
        errors = error_budget(sensor)
        error = rng.uniform(-errors.clock_error, errors.clock_error)
        # A free-running clock starts anywhere within a millisecond of the bench's.
        self._phase = int(rng.integers(MILLISECOND)) if errors.clock_error else 0
        self._tick = round(MILLISECOND * (1.0 + error))
        self._transducer = build(sensor, rng)
        self._warm = 2 * round(errors.warm_up_time * 1e9)
        self._ids = Identifiers.of(sensor.node)
        self._framing = Framing(sensor, self._ids)
        self._announcer = Announcer(self._ids)
        settings = Settings.of(sensor)
        self._server = CommandServer(sensor, self._transducer, settings, self._answer)
        self._boot_time = round(sensor.boot_time * 1e9)
        self._outbox: list[Timed] = []
        self._held = np.zeros((1, 6))
        self._now = 0
        self.boots = 0
        self.listened = False
        self.samples: Batch | None = None
        self.reboot(0)

    @property
    def transducer(self) -> Transducer:
        return self._transducer

    @property
    def booting(self) -> bool:
        return self._booting

    @property
    def settings(self) -> Settings:
        """Rate and filter, one set for every front."""
        return self._server.settings

    @property
    def tare(self) -> Tare:
        """The zero, one for every front."""
        return self._server.tare

    def reboot(self, t: int) -> None:
        """Restart at t, as after a brown-out: tare gone, silent until told to transmit."""
        self._server.reboot()
        self._up = t + self._boot_time
        self._booting = True
        self.boots += 1
        self._conversion = 0
        self._alarms = 0
        self._outbox.append(self._announcer.boot(t))

    def receive(self, frame: CanFrame, t: int) -> None:
        """Take a frame off the bus at t; anything but a command to this node is not for it."""
        if frame.id != self._ids.command or frame.fd or t < self._up:
            return
        try:
            command = decode_command(frame.data)
        except ProtocolError:
            return  # a node has nobody to tell; the host's retry is the remedy
        self._now = t
        self._server.execute(command)
        if self._server.operation.reset_requested:
            self.reboot(t)

    def advance(self, t: int, wrenches: Array) -> list[Timed]:
        """Frames that leave in the milliseconds up to t, with their times, ns.

        wrenches: true wrench at each of those milliseconds, sensor frame, (n, 6).
        """
        start = t - len(wrenches) * MILLISECOND
        self._now = t
        if self._booting and self._up <= t:
            self._booting = False
            self._announcer.ready(self._up)
        times = self._conversions(t)
        # A conversion sees the last millisecond's wrench: nothing from its own future.
        history = np.concatenate((self._held, wrenches))
        self._held = history[-1:]
        counts = self._transducer.measure(t, history[_rows(times, start, len(wrenches))])
        self.samples = None
        if not self._booting:
            self._sample(times, counts)
            self._announce(t)
        return self._leaving(t)

    def _conversions(self, t: int) -> list[int]:
        """Moments up to t at which the node's own clock makes it convert."""
        times = []
        moment = self._up + self._phase + self._conversion * self._tick
        while moment <= t:
            times.append(moment)
            moment += self._tick
        self._conversion += len(times)
        return times

    def _sample(self, times: list[int], counts: Counts) -> None:
        operation, tare = self._server.operation, self._server.tare
        alarms = self._alarmed(counts, operation)
        if not (operation.transmit or self.listened) or not times:
            return
        period = self._server.settings.period
        first = -(self._conversion - len(times)) % period
        chosen = slice(first, None, period)
        was_tared = tare.set
        values, still_old = tare.apply(counts.values[chosen], operation.sent)
        batch = Batch(times[chosen], values, alarms and alarms[chosen], operation.sent, still_old)
        self.samples = batch
        if operation.transmit:
            self._outbox += self._framing.frames(batch, (was_tared, tare.set))
            operation.sent += len(batch.times)

    def _alarmed(self, counts: Counts, operation: Operation) -> list[int] | None:
        """The alarms of these samples, None where there are none; a damaged gauge stays so."""
        if counts.alarms is None and not operation.gauge_fault:
            self._alarms = 0 if len(counts.values) else self._alarms
            return None
        alarms = [0] * len(counts.values) if counts.alarms is None else counts.alarms.tolist()
        self._alarms = alarms[-1] if alarms else self._alarms
        operation.gauge_fault |= any(alarm & DAMAGED for alarm in alarms)
        return [alarm | DAMAGED for alarm in alarms] if operation.gauge_fault else alarms

    def _announce(self, t: int) -> None:
        operation = self._server.operation
        state = NodeState.OPERATIONAL if operation.transmit else NodeState.PRE_OPERATIONAL
        self._outbox += self._announcer.until(t, state, self._status_bits(t), operation.sent)

    def _status_bits(self, t: int) -> int:
        operation = self._server.operation
        bits = self._alarms & 0x7F
        for bit, on in (
            (ANY_GAUGE_FAULT, operation.gauge_fault),
            (TRANSMIT_ON, operation.transmit),
            (TARED, self._server.tare.set),
            (FILTER_ON, self._server.settings.cutoff),
            (WARMING_UP, t < self._warm),
        ):
            if on:
                bits |= bit
        return bits

    def _answer(self, reply: Reply) -> None:
        self._outbox.append((self._now + REPLY_DELAY, encode_reply(self._ids, reply)))

    def _leaving(self, t: int) -> list[Timed]:
        """The outbox up to t, in order; a TORQUE still on its way stays for the next period."""
        outbox = self._outbox
        outbox.sort(key=_emission_time)
        cut = bisect_right(outbox, t, key=_emission_time)
        leaving, self._outbox = outbox[:cut], outbox[cut:]
        return leaving


def _rows(times: list[int], start: int, last: int) -> slice | list[int]:
    """Which millisecond of the history each conversion sees; a slice where they follow suit."""
    if not times:
        return slice(0, 0)
    first = max(0, (times[0] - start) // MILLISECOND)
    end = min((times[-1] - start) // MILLISECOND, last)
    if end - first == len(times) - 1:
        return slice(first, end + 1)
    return [min(max(0, (moment - start) // MILLISECOND), last) for moment in times]
