"""The conversation with one sensor node, without a bus: frames and times in, wrenches out."""

from bisect import insort
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Final, TypeAlias

from drivers.errors import (
    CommandRefusedError,
    NotReadyError,
    OverloadError,
    ProtocolError,
    SensorError,
    SensorResetError,
    StaleSampleError,
)
from drivers.interfaces import Freshness as Standing
from drivers.interfaces import WrenchReading
from drivers.nrs.assembler import Assembler, NumberedSample
from drivers.nrs.freshness import Freshness
from drivers.nrs.plausibility import OFF, Plausibility, Plausible
from drivers.nrs.requests import Requests
from drivers.protocol.frame import CanFrame
from drivers.protocol.nrs_can import FAULT, OVERLOAD, SATURATED, TARED, VALID, Identifiers
from drivers.protocol.nrs_command import TARE_NEGATIVE_OF_CURRENT, Opcode, decode_reply
from drivers.protocol.nrs_status import NodeState, StatusBit, decode_heartbeat, decode_status

BOOT_LIMIT: Final = 3_000_000_000
"""Longest wait for the first heartbeat, ns of arm time."""
STATUS_REORDER: Final = 8
"""Two STATUS frames may overtake each other by this many samples; further back is a reset."""

Heard: TypeAlias = tuple[int, bytes, bool]
"""What a CanFrame says (identifier, payload, FD), plain: 2000 frames a second come by here."""

UNUSABLE: Final = OVERLOAD | SATURATED | FAULT


@dataclass(slots=True)
class _Stream:
    """What is known since the last start; t and waiting_from in ns, sample_count from STATUS."""

    newest: NumberedSample | None = None
    observed: NumberedSample | None = None
    fresh: list[NumberedSample] = field(default_factory=list)
    zero_from: int = 0
    sample_count: int | None = None
    reset: bool = False
    alive: bool = False
    waiting_from: int | None = None
    refusal: CommandRefusedError | None = None


class Session:
    """Understands one node's frames; period: between samples, max_age: of the newest one, ns."""

    def __init__(
        self, node: int, fd: bool, period: int, max_age: int, plausible: Plausible = OFF
    ) -> None:
        self._node = node
        self._plausibility = Plausibility(plausible)
        self._ids = Identifiers.of(node)
        self._period = period
        self._max_age = max_age
        self.assembler = Assembler(self._ids, fd)
        self.foreign = 0
        self.last_error = ""
        self._freshness = Freshness(period)
        self._requests = Requests(self._ids)
        self._stream = _Stream()
        samples = (self._ids.wrench_fd,) if fd else (self._ids.force, self._ids.torque)
        self._sample_ids = frozenset(samples)
        self._handlers: dict[int, Callable[[CanFrame, int], None]] = {
            self._ids.status: self._on_status,
            self._ids.heartbeat: self._on_heartbeat,
            self._ids.reply: self._on_reply,
            self._ids.emergency: lambda *_: None,  # the flags of the samples say the same
            self._ids.command: lambda *_: None,  # udp_multicast returns what we sent
        }

    def start(self) -> None:
        """Ask the node to transmit from scratch: what was known of its count and zero is void."""
        self.assembler.restart()
        self._freshness.restart()
        self._plausibility.restart()
        self._stream = _Stream()
        self._requests.clear()
        self._requests.put(Opcode.TRANSMIT, (1,))

    def begin_tare(self, samples: int) -> None:
        """Ask for a zero on the mean of so many samples; ValueError for none."""
        if samples < 1:
            raise ValueError(f"a tare needs at least one sample, not {samples}")
        arguments = (TARE_NEGATIVE_OF_CURRENT, samples)
        self._requests.put(Opcode.TARE, arguments, duration=samples * self._period)

    @property
    def ready(self) -> bool:
        return self._stream.newest is not None and not self._requests.pending(Opcode.TRANSMIT)

    @property
    def tare_pending(self) -> bool:
        return self._requests.pending(Opcode.TARE)

    def take(self, frames: Iterable[Heard], t: int) -> None:
        """Understand standard data frames that were there at arm time t, in bus order."""
        accept, keep, sample_ids = self.assembler.accept, self._keep, self._sample_ids
        self.assembler.begin()
        for identifier, octets, fd in frames:
            if identifier in sample_ids:
                sample = accept(identifier, octets, fd, t)
                if sample is not None:
                    keep(sample)
            else:
                self._hear(CanFrame(identifier, octets, fd), t)
        newest = self._stream.newest
        if newest is not None and newest is not self._stream.observed:
            # Of samples that came together the newest was delayed least: it moves the anchor.
            self._freshness.observe(newest.number, t)
            self._stream.observed = newest

    def _hear(self, frame: CanFrame, t: int) -> None:
        handler = self._handlers.get(frame.id)
        if handler is None or frame.fd:
            self.foreign += 1
            return
        try:
            handler(frame, t)
        except ProtocolError as error:
            self.assembler.malformed += 1
            self.last_error = str(error)

    def due(self, t: int) -> CanFrame | None:
        """What to send at arm time t; raises the CommandRefusedError that a command came to."""
        stream = self._stream
        if stream.refusal is not None:
            refusal, stream.refusal = stream.refusal, None
            raise refusal
        if stream.alive:
            return self._requests.due(t)
        if stream.waiting_from is None:
            stream.waiting_from = t
        elif self._requests.pending(Opcode.TRANSMIT) and t - stream.waiting_from > BOOT_LIMIT:
            self._requests.clear()
            raise CommandRefusedError(
                f"node {self._node} has sent no heartbeat for {BOOT_LIMIT / 1e9:g} s: check node "
                "id, bitrate, power and termination"
            )
        return None

    def reading(self, t: int) -> WrenchReading:
        """The newest wrench at arm time t, or the SensorError that says why there is none."""
        stream = self._stream
        if stream.reset:
            raise SensorResetError(f"node {self._node} restarted: its tare is gone; start() again")
        newest = stream.newest
        if newest is None:
            raise NotReadyError(f"node {self._node} has sent no complete sample yet")
        fresh, stream.fresh = stream.fresh, []
        age = self._freshness.age(newest.number, t)
        if age > self._max_age:
            raise StaleSampleError(
                f"sample {newest.number} is {age / 1e6:.1f} ms old, the limit is "
                f"{self._max_age / 1e6:g} ms"
            )
        for sample in fresh or (newest,):
            if sample.flags & UNUSABLE or not sample.flags & VALID:
                raise _unusable(sample)
        self._plausibility.check()
        return WrenchReading(
            wrench=newest.wrench,
            samples=tuple([sample.wrench for sample in fresh]),
            counter=newest.number,
            age=age,
            freshness=Standing.OK if fresh else Standing.HELD,
            tared=bool(newest.flags & TARED),
        )

    def discard(self) -> None:
        """Forget the samples since the last reading: nobody may control on them."""
        self._stream.fresh = []

    def _keep(self, sample: NumberedSample) -> None:
        self._plausibility.watch(sample.wrench)
        stream = self._stream
        if sample.number < stream.zero_from:
            return
        if stream.newest is None or sample.number > stream.newest.number:
            stream.newest = sample
            stream.fresh.append(sample)
        else:
            insort(stream.fresh, sample)  # by number: it came late

    def _on_status(self, frame: CanFrame, t: int) -> None:
        status = decode_status(frame.data)
        stream = self._stream
        stream.alive = True
        before, stream.sample_count = stream.sample_count, status.sample_count
        if before is not None and status.sample_count < before - STATUS_REORDER:
            self._on_restart()
        if status.bits & StatusBit.TRANSMIT_ON:
            self.assembler.synchronise(status.sample_count, t)

    def _on_heartbeat(self, frame: CanFrame, t: int) -> None:
        booted = decode_heartbeat(frame.data) is NodeState.BOOT
        self._stream.alive = not booted
        if booted:
            self._stream.waiting_from = t
            self._on_restart()

    def _on_restart(self) -> None:
        """The node has booted: harmless while starting, the end of trust once samples flowed."""
        stream = self._stream
        stream.reset = stream.reset or stream.newest is not None
        stream.newest, stream.fresh, stream.sample_count = None, [], None
        self.assembler.restart()
        self._requests.rewind()

    def _on_reply(self, frame: CanFrame, t: int) -> None:
        try:
            reply = self._requests.answer(decode_reply(frame.data))
        except CommandRefusedError as refusal:
            self._stream.refusal = refusal
            return
        if reply is not None and reply.opcode == Opcode.TARE:
            self._move_zero(reply.values[0])

    def _move_zero(self, counter: int) -> None:
        """Drop samples on the old zero: mixing two zeros is a step that nobody pushed."""
        stream = self._stream
        if stream.newest is not None:
            stream.zero_from = self.assembler.nearest(counter)
            stream.fresh = [one for one in stream.fresh if one.number >= stream.zero_from]


def _unusable(sample: NumberedSample) -> SensorError:
    if sample.flags & (OVERLOAD | SATURATED):
        return OverloadError(f"sample {sample.number} is out of range: {sample.wrench}")
    return SensorError(f"sample {sample.number}: the node says that its gauges are faulty")
