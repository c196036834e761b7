"""The RTDE link between session and socket, with its faults."""

import socket
from collections import deque
from collections.abc import Iterator
from itertools import islice
from typing import Final

from drivers.protocol.rtde_variables import INPUTS
from hil.cell.arm.connection import Connection, Cut
from hil.cell.arm.door_log import Event
from hil.cell.arm.ownership import FIELDBUS, Ownership
from hil.cell.arm.rtde_session import RtdeSession
from hil.cell.faults.injector import FOREVER, Running
from hil.cell.injection import packages
from hil.cell.injection.injection import Injection

NS: Final = 1_000_000_000
TO_CELL, FROM_CELL = "to_cell", "from_cell"
KEPT: Final = 128
"""Packages remembered for a replay."""


class RtdeLink:
    """What holds for every client of the link. now: bench time, ns.

    absent: until then, ns, no client is heard or hears anything.
    """

    def __init__(self, injection: Injection) -> None:
        self._injection = injection
        self.now = self.absent = 0

    def ways(self, kind: str, way: str) -> Iterator[Running]:
        """The faults of a row that concern this direction."""
        for one in self._injection.of(kind):
            if one.fault.parameters.get("direction", "both") in ("both", way):
                yield one

    def of(self, kind: str) -> tuple[Running, ...]:
        return self._injection.of(kind)

    def extra(self, way: str) -> int:
        """How much longer a package takes that sets out now, ns."""
        self._injection.hear()
        found = max(0, self.absent - self.now)
        for one in self.ways("T1", way):
            found += _latency(one, self.now, way)
            one.felt(self.now, f"+{found / NS:.6g} s")
        for one in self.ways("T2", way):
            found += round(one.fault.number("size") * NS)
            one.felt(self.now, f"+{found / NS:.6g} s")
        for kind in ("T3", "T4"):
            for one in self.ways(kind, way):
                found = max(found, one.until - self.now)
                one.felt(self.now, f"a package {way} waits")
        return min(found, FOREVER)

    def seize(self, ownership: Ownership, one: Running, t: int) -> None:
        """Another client takes every input."""
        ownership.seize(INPUTS, FIELDBUS)
        one.felt(t, "inputs taken")


def _latency(one: Running, t: int, way: str) -> int:
    mean, jitter = one.fault.number("mean"), one.fault.number("jitter")
    rng = one.draws(2 * t + (way == TO_CELL))
    law = one.fault.word("law")
    if law == "uniform":
        mean += jitter * float(rng.uniform(-1.0, 1.0))
    elif law == "normal":
        mean += jitter * float(rng.standard_normal())
    return max(0, round(mean * NS))


class Delays:
    """A link's own travel times, and what its faults add to them, ns."""

    def __init__(self, sound: Iterator[int], link: RtdeLink, way: str) -> None:
        self._sound, self._link, self._way = sound, link, way

    def __iter__(self) -> "Delays":
        return self

    def __next__(self) -> int:
        return next(self._sound) + self._link.extra(self._way)


class InjectedConnection(Connection):
    """One client's packages on their way. A command that a fault swallows still ends a period: in
    lockstep the cell waits for what the client sends, not for what arrives.
    """

    __slots__ = ("_cutter", "_fate", "_held", "_link", "_past_in", "_past_out", "_rtde", "_travel")

    def __init__(
        self, client: socket.socket, session: RtdeSession, delays: Iterator[int], link: RtdeLink
    ) -> None:
        super().__init__("rtde", client, session, delays)
        self._link, self._rtde, self._travel = link, session, delays
        self._cutter = packages.Cutter()
        self._past_in: deque[bytes] = deque(maxlen=KEPT)
        self._past_out: deque[bytes] = deque(maxlen=KEPT)
        self._held: dict[str, bytes] = {}
        self._fate: Cut | None = None

    def hear(self, data: bytes, t: int) -> None:
        """The client's bytes, as far as they come through; raises Cut."""
        found = self._cutter.feed(data)
        sent = sum(map(packages.is_data, found))
        before = self._rtde.commands
        for package in found:
            for piece in self._pieces(self._inbound(package, t), t):
                super().hear(piece, t)
        self._rtde.commands = before + sent

    def publish(self, t: int, step: int) -> None:
        """Put on its way what is left of the session's package."""
        package = self.session.publish(step)
        if not package and FROM_CELL not in self._held:
            return
        due = max(self._last_due, t + next(self._travel))
        for whole in self._outbound(package, t):
            due += self._throttled(len(whole), t)
            self._travelling.append((due, whole))
        self._last_due = due

    @property
    def next_due(self) -> int | None:
        """A package held back has not gone: the client has nothing to answer yet."""
        due = super().next_due
        return FOREVER if due is None and FROM_CELL in self._held else due

    def flush(self, t: int) -> None:
        if self._fate is not None:
            raise self._fate
        super().flush(t)

    def send(self) -> None:
        """In one piece, or in as many as a fault cuts it into."""
        rest = self._out
        for one in self._link.ways("T7", FROM_CELL):
            size = int(one.fault.number("size"))
            while len(rest) > size:
                self._out, rest = rest[:size], rest[size:]
                super().send()
                if self._out:  # the kernel is full
                    self._out += rest
                    return
                one.felt(self._link.now, f"cut into {size} bytes")
            self._out = rest
        super().send()

    def reset(self, how: str) -> None:
        """Make closing the socket a reset (`rst`); a `fin` needs nothing."""
        if how == "rst":
            linger(self.socket)

    def _pieces(self, found: list[bytes], t: int) -> Iterator[bytes]:
        size = 0
        for one in self._link.ways("T7", TO_CELL):
            size = int(one.fault.number("size"))
            one.felt(t, f"cut into {size} bytes")
        for package in found:
            if not size:
                yield package
            octets = iter(package) if size else iter(())
            while piece := bytes(islice(octets, size)):
                yield piece

    def _inbound(self, package: bytes, t: int) -> list[bytes]:
        for one in self._link.of("T10"):
            wrong = packages.refused(package, one.fault.word("what"))
            if wrong != package:
                one.felt(t, one.fault.word("what"))
            package = wrong
        if not packages.is_data(package):
            return [package]
        for one in self._link.of("T12"):
            one.felt(t, "a command is not taken")
            self._out += packages.in_use()
            return []
        return self._replayed(self._bent(package, t, TO_CELL), t, TO_CELL)

    def _outbound(self, package: bytes, t: int) -> list[bytes]:
        return self._replayed(self._bent(package, t, FROM_CELL), t, FROM_CELL)

    def _bent(self, package: bytes, t: int, way: str) -> bytes:
        for one in self._link.ways("T8", way):
            rng = one.draws(2 * t + (way == TO_CELL))
            if package and rng.random() < one.fault.number("share"):
                bits = int(one.fault.number("bits"))
                package = packages.bent(package, one.fault.word("field"), bits, rng)
                one.felt(t, f"{one.fault.word('field')} {way}")
        return package

    def _replayed(self, package: bytes, t: int, way: str) -> list[bytes]:
        past = self._past_in if way == TO_CELL else self._past_out
        sound = [package] if package else []
        found = sound
        for one in self._link.ways("T9", way):
            how, depth = one.fault.word("how"), int(one.fault.number("depth"))
            if how == "duplicate":
                found = found * 2
            elif how == "replay" and len(past) >= depth:
                found = [*found, past[-depth]]
            elif how == "reorder":
                found = self._reordered(found, way)
            if found != sound:
                one.felt(t, f"{how} {way}")
        if way in self._held and not any(self._link.ways("T9", way)):
            found = [self._held.pop(way), *found]
        if package:
            past.append(package)
        return found

    def _reordered(self, found: list[bytes], way: str) -> list[bytes]:
        """Every other package waits for the next one, which overtakes it."""
        if way in self._held:
            return [*found, self._held.pop(way)]
        if found:
            self._held[way] = found[0]
        return []

    def _throttled(self, size: int, t: int) -> int:
        """How long so many bytes take where the client reads slowly, ns; a full buffer ends it."""
        took = 0
        for one in self._link.of("T11"):
            one.felt(t, "packages wait for the client")
            took = round(size / one.fault.number("rate") * NS)
            waiting = sum(len(whole) for _, whole in self._travelling)
            if waiting > one.fault.number("buffer"):
                self._fate = Cut(Event.CUT_OFF, f"{waiting} bytes unread by a slow client")
        return took


def linger(client: socket.socket) -> None:
    """Let `close` send a reset."""
    client.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\x01\x00\x00\x00\x00\x00\x00\x00")
