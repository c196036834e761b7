"""The conversation with the sensor over its TCP protocol, without a socket: bytes in, wrenches out.

The protocol has no counter, so samples are numbered as they come: a TCP stream loses none. Age is
judged by number as on CAN, for a stalled network delivers old samples in one burst.
"""

from dataclasses import dataclass, field
from typing import Final, NamedTuple

from drivers.errors import (
    CommandRefusedError,
    NotReadyError,
    OverloadError,
    ProtocolError,
    StaleSampleError,
)
from drivers.interfaces import Freshness as Standing
from drivers.interfaces import Vector6, WrenchReading
from drivers.nrs.freshness import Freshness
from drivers.nrs.plausibility import Plausibility, Plausible
from drivers.nrs.tcp_requests import ANSWER_TIME, TcpRequests
from drivers.nrs.zero import Zero
from drivers.protocol.errors import WireError
from drivers.protocol.nrs_tcp import MAX_PERIOD, Cutter, Kind, Message, decode_wrench

MILLISECOND: Final = 1_000_000
CATCH_UP: Final = 200_000_000
"""A stalled stream catches up in a burst; one that stays late for so long, ns, has lost samples
inside the sensor, and they are counted as gaps.
"""


class Range(NamedTuple):
    """Rated range, N and N·m: the protocol has no overload flag."""

    force: float = 500.0
    torque: float = 10.0

    def holds(self, wrench: Vector6) -> bool:
        fx, fy, fz, tx, ty, tz = map(abs, wrench)
        return max(fx, fy, fz) <= self.force and max(tx, ty, tz) <= self.torque


NRS_6050_D80: Final = Range()


@dataclass(slots=True)
class _Stream:
    """What is known since the last start; times in ns of arm time."""

    newest: Vector6 | None = None
    tared: bool = False
    fresh: list[Vector6] = field(default_factory=list)
    overload: Vector6 | None = None
    late_since: int | None = None
    zero_until: int | None = None
    started: bool = False


class TcpSession:
    """period: between samples; max_age: of the newest one, ns."""

    def __init__(self, period: int, max_age: int, rated: Range, plausible: Plausible) -> None:
        if period % MILLISECOND or not 1 <= period // MILLISECOND <= MAX_PERIOD:
            raise ValueError(
                f"{period / MILLISECOND:g} ms between samples; the sensor's TCP protocol allows "
                f"whole milliseconds from 1 to {MAX_PERIOD}"
            )
        self._period, self._max_age, self._rated = period, max_age, rated
        self._plausibility = Plausibility(plausible)
        self._freshness = Freshness(period)
        self._requests = TcpRequests()
        self._cutter = Cutter()
        self._zero = Zero()
        self._stream = _Stream()
        self._samples_of_tare = 0
        self._number = -1
        self.received = self.gaps = self.malformed = self.foreign = 0
        self.last_error = ""

    def connected(self) -> None:
        """A new stream begins: whatever the old one left half said is void."""
        self._cutter = Cutter()
        self._forget()

    def start(self) -> None:
        """Ask the sensor to stream from scratch."""
        self._forget()
        self._requests.put(Kind.PERIOD, self._period // MILLISECOND)
        self._requests.put(Kind.TRANSMIT, 1)

    def begin_tare(self, samples: int) -> None:
        """Ask for the sensor's zero, then take the rest off by a mean; ValueError for none."""
        if samples < 1:
            raise ValueError(f"a tare needs at least one sample, not {samples}")
        self._samples_of_tare = samples
        self._requests.put(Kind.TARE, 1)

    @property
    def ready(self) -> bool:
        return self._stream.newest is not None and not self._requests.pending(Kind.TRANSMIT)

    @property
    def tare_pending(self) -> bool:
        return self._requests.pending(Kind.TARE) or self._zero.missing > 0

    def take(self, octets: bytes, t: int) -> None:
        """Understand bytes that were there at arm time t; ProtocolError: hang up."""
        try:
            messages = self._cutter.feed(octets)
        except WireError as error:
            raise ProtocolError(str(error)) from error
        before = self._number
        for message in messages:
            if message.kind == Kind.DATA:
                self._sample(message)
            else:
                self._answer(message, t)
        if self._number > before:
            self._freshness.observe(self._number, t)
            self._mind_lost_samples(t)

    def due(self, t: int) -> bytes:
        """What to send at arm time t; raises the CommandRefusedError that a command came to."""
        limit = self._stream.zero_until
        if limit is not None and self._zero.missing and t > limit:
            missing = self._zero.missing
            self._zero.clear()
            raise CommandRefusedError(
                f"TARE: {missing} of {self._samples_of_tare} samples did not come"
            )
        return self._requests.due(t)

    def reading(self, t: int) -> WrenchReading:
        """The newest wrench at arm time t, or the SensorError that says why there is none."""
        stream = self._stream
        newest = stream.newest
        if newest is None:
            raise NotReadyError("the sensor has sent no sample yet")
        fresh, stream.fresh = stream.fresh, []
        overload, stream.overload = stream.overload, None
        age = self._freshness.age(self._number, t)
        if age > self._max_age:
            raise StaleSampleError(
                f"sample {self._number} is {age / 1e6:.1f} ms old, the limit is "
                f"{self._max_age / 1e6:g} ms"
            )
        if overload is not None or not self._rated.holds(newest):
            raise OverloadError(f"a sample is out of range: {overload or newest}")
        self._plausibility.check()
        standing = Standing.OK if fresh else Standing.HELD
        return WrenchReading(newest, tuple(fresh), self._number, age, standing, stream.tared)

    def _forget(self) -> None:
        self._stream = _Stream()
        self._requests.clear()
        self._zero.clear()
        self._freshness.restart()
        self._plausibility.restart()

    def _sample(self, message: Message) -> None:
        stream, zero = self._stream, self._zero
        if not stream.started:
            return  # left over from a stream that somebody else began, at another rate
        try:
            wrench = decode_wrench(message.payload)
        except WireError as error:
            self.malformed += 1
            self.last_error = str(error)
            return
        self.received += 1
        self._number += 1
        self._plausibility.watch(wrench)
        if not self._rated.holds(wrench):
            stream.overload = wrench
        if zero.take(wrench):
            stream.fresh.clear()  # on the old zero: mixing two is a step that nobody pushed
        stream.newest, stream.tared = zero.apply(wrench), zero.set
        stream.fresh.append(stream.newest)

    def _answer(self, message: Message, t: int) -> None:
        kind = self._requests.answer(message.kind)
        if kind is None:
            self.foreign += 1
        elif kind is Kind.TRANSMIT:
            self._stream.started = True
        elif kind is Kind.TARE:
            # The sensor's zero has moved between the samples before and after this answer.
            self._stream.fresh.clear()
            self._zero.begin(self._samples_of_tare)
            self._stream.zero_until = t + self._samples_of_tare * self._period + ANSWER_TIME

    def _mind_lost_samples(self, t: int) -> None:
        stream = self._stream
        age = self._freshness.age(self._number, t)
        if age <= self._max_age:
            stream.late_since = None
        elif stream.late_since is None:
            stream.late_since = t
        elif t - stream.late_since > CATCH_UP:
            lost = age // self._period
            self._number += lost
            self.gaps += lost
            stream.late_since = None
