"""Joins the halves of a sample by counter and numbers samples without wrap; no bus in here.

Keeping the last of each half instead would mix two samples whenever a frame is lost.
"""

from typing import Final, NamedTuple, TypeAlias

from drivers.interfaces import Vector6
from drivers.protocol.nrs_can import Identifiers, ProtocolError
from drivers.protocol.nrs_sample import Sample, decode_fd, decode_pair

WINDOW: Final = 2
"""Samples that may be half complete at once; an older half has lost its partner."""
HALF_LIFE: Final = 20_000_000
"""Longest wait of a half for its partner, ns: a partner later than that may be a wrap later."""
_PAYLOAD: Final = 8
OUTAGE: Final = 100_000_000
"""Silence after which an 8-bit counter (256 ms) may have wrapped, ns."""


class NumberedSample(NamedTuple):
    """number: how many samples the node sent before this one since its boot."""

    number: int
    wrench: Vector6
    flags: int


_Half: TypeAlias = tuple[bool, bytes, int]
"""(whether it is the force half, payload, arm time of arrival): plain, as there are 2000 a s."""


class Assembler:
    """Takes data frames, gives each sample once, counts everything it drops.

    Samples of one batch may come in any order; one that is older than its batch is dropped, for
    what followed it has been acted on. The counter's wraps are known only once STATUS has told the
    node's own count, so no sample comes before the first STATUS, nor after an outage before the
    next one.
    """

    def __init__(self, identifiers: Identifiers, fd: bool) -> None:
        self._ids = identifiers
        self._fd = fd
        self._modulus = 1 << 16 if fd else 1 << 8
        self._halves: dict[int, _Half] = {}  # by counter, oldest first
        self._last: int | None = None
        self._last_t = 0
        self._floor = -1  # newest sample of the batches before this one
        self._given: set[int] = set()  # samples of this batch
        self._synchronised = False
        self.pairs = self.gaps = self.duplicates = self.torn = self.malformed = 0
        self.last_error = ""

    def restart(self) -> None:
        """Forget counter and halves, as after a node reset; the counts of losses stay."""
        self._halves.clear()
        self._last = None
        self._synchronised = False
        self.begin()

    def begin(self) -> None:
        """A new batch of frames: the samples so far are no longer waited for."""
        self._floor = -1 if self._last is None else self._last
        self._given.clear()

    def synchronise(self, sample_count: int, t: int) -> None:
        """Take the number of samples sent from a STATUS that arrived at t."""
        newest = sample_count - 1
        last = newest if self._last is None else self._last
        if not self._synchronised or abs(newest - last) >= self._modulus // 2:
            self.gaps += max(0, newest - last)
            self._last = newest
            self._halves.clear()
            self.begin()
        self._synchronised, self._last_t = True, t

    def accept(self, identifier: int, octets: bytes, fd: bool, t: int) -> NumberedSample | None:
        """The sample that this data frame completes at arm time t, if it does."""
        if self._synchronised and t - self._last_t > OUTAGE:
            self._synchronised = False
        try:
            if fd or self._fd or len(octets) != _PAYLOAD:
                sample: Sample | None = self._other(identifier, octets, fd)
            else:
                sample = self._join(identifier == self._ids.force, octets, t)
        except ProtocolError as error:
            self._reject(str(error))
            return None
        return None if sample is None else self._number(sample, t)

    def _other(self, identifier: int, octets: bytes, fd: bool) -> Sample:
        """The sample in a CAN FD frame; ProtocolError for what is not meant to be here."""
        if fd != self._fd:
            raise ProtocolError(f"frame {identifier:#x} is {'' if fd else 'not '}CAN FD")
        if not fd:
            raise ProtocolError(f"frame {identifier:#x} has {len(octets)} bytes instead of 8")
        return decode_fd(self._ids, octets)

    def _join(self, is_force: bool, octets: bytes, t: int) -> Sample | None:
        """The sample whose other half has been waiting; None while a half waits."""
        counter = octets[7]
        half = self._halves.pop(counter, None)
        if half is None or t - half[2] > HALF_LIFE:
            self.torn += half is not None
            self._wait(counter, (is_force, octets, t))
            return None
        if half[0] == is_force:
            self.duplicates += 1
            self._halves[counter] = half
            return None
        return decode_pair(octets, half[1]) if is_force else decode_pair(half[1], octets)

    def _wait(self, counter: int, half: _Half) -> None:
        halves, last = self._halves, self._last
        # In order, which it nearly always is, a half is of the sample after the last.
        if last is not None and self._synchronised and counter != last + 1 & 0xFF:
            number = last + self._distance(counter, last)
            given = number in self._given or number == last
            self.duplicates += given  # its sample is complete already
            self.torn += number <= self._floor and not given  # its turn is over
            if given or number <= self._floor:
                return
        halves[counter] = half
        if len(halves) > WINDOW:
            del halves[next(iter(halves))]
            self.torn += 1

    def _number(self, sample: Sample, t: int) -> NumberedSample | None:
        last = self._last
        if last is None or not self._synchronised:
            return None
        wrench, flags, counter = sample
        step = self._distance(counter, last)
        number = last + step
        if number <= self._floor or number in self._given:
            self.duplicates += 1
            return None
        self.pairs += 1
        self.gaps += step - 1 if step > 0 else -1  # a late one fills the gap it had left
        self._given.add(number)
        if step > 0:
            self._last, self._last_t = number, t
        return NumberedSample(number, wrench, flags)

    def nearest(self, counter: int) -> int:
        """The number nearest the last sample's whose low byte is `counter`."""
        last = self._last or 0
        return last + (counter - last + 128) % 256 - 128

    def _distance(self, counter: int, number: int) -> int:
        """Signed way from a number to the nearest one with this counter."""
        half = self._modulus // 2
        return (counter - number + half) % self._modulus - half

    def _reject(self, reason: str) -> None:
        self.malformed += 1
        self.last_error = reason
