"""Builtins of TCP: the program as a client. Waiting takes robot time, cycle by cycle."""

import math
import re
import struct
from collections.abc import Callable, Generator
from typing import Final, TypeVar

from hil.cell.arm.port import RobotPort
from hil.cell.arm.urscript.builtins.strings import shown
from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.values import List, Value, integer, number, text

_NAME: Final = "socket_0"
_CONNECT: Final = 2.0  # s (Script Manual, socket_open)
_READ: Final = 2.0  # s, the manual's default; 0 or less waits for ever
_FAILED: Final = -1  # what fills the list of a read that failed; assumed
_FLOATS: Final = re.compile(rb"\(([^()]*)\)[\r\n]*")

T = TypeVar("T")
Reading = Generator[None, None, T]


class SocketCalls:
    """Numbers go out and come in big-endian, 32 bits (Script Manual, module interfaces)."""

    def __init__(self, port: RobotPort) -> None:
        self._port = port

    def socket_open(self, address: Value, port: Value, socket_name: Value = _NAME) -> Reading[bool]:
        sockets, name = self._port.sockets, text(socket_name)
        sockets.open(name, text(address), integer(port))
        deadline = self._port.t + round(_CONNECT * 1e9)
        yield
        while (connected := sockets.connected(name)) is None and self._port.t < deadline:
            yield
        if not connected:
            sockets.close(name)
        return bool(connected)

    def socket_close(self, socket_name: Value = _NAME) -> None:
        self._port.sockets.close(text(socket_name))

    def socket_send_byte(self, value: Value, socket_name: Value = _NAME) -> bool:
        return self._send(bytes([integer(value) & 0xFF]), socket_name)

    def socket_send_int(self, value: Value, socket_name: Value = _NAME) -> bool:
        return self._send(struct.pack(">i", integer(value)), socket_name)

    def socket_send_line(self, str: Value, socket_name: Value = _NAME) -> bool:
        return self._send(shown(str).encode() + b"\n", socket_name)

    def socket_send_string(self, str: Value, socket_name: Value = _NAME) -> bool:
        return self._send(shown(str).encode(), socket_name)

    def socket_set_var(self, name: Value, value: Value, socket_name: Value = _NAME) -> bool:
        return self._send(f"SET {text(name)} {integer(value)}\n".encode(), socket_name)

    def socket_get_var(self, name: Value, socket_name: Value = _NAME) -> Reading[int]:
        """The integer that the peer answers to "GET name" with; -1 for none."""
        self._send(f"GET {text(name)}\n".encode(), socket_name)
        line = yield from self._until(_line, socket_name, _READ)
        found = re.fullmatch(rb"\s*%s\s+(-?\d+)\s*" % re.escape(text(name).encode()), line or b"")
        return int(found[1]) if found else _FAILED

    def socket_read_binary_integer(
        self, number: Value, socket_name: Value = _NAME, timeout: Value = _READ
    ) -> Reading[List]:
        """[how many, integer, ...]."""
        count = _count(number)
        got = yield from self._until(_bytes(4 * count), socket_name, timeout)
        return _list(count, None if got is None else struct.unpack(f">{count}i", got))

    def socket_read_byte_list(
        self, number: Value, socket_name: Value = _NAME, timeout: Value = _READ
    ) -> Reading[List]:
        """[how many, byte, ...]."""
        count = _count(number)
        got = yield from self._until(_bytes(count), socket_name, timeout)
        return _list(count, got)

    def socket_read_ascii_float(
        self, number: Value, socket_name: Value = _NAME, timeout: Value = _READ
    ) -> Reading[List]:
        """[how many, float, ...] of "(1.0, 2.5)"; what is not a number reads as nan."""
        count = _count(number)
        got = yield from self._until(_parenthesis, socket_name, timeout)
        values = [] if got is None else [_float(field) for field in got.split(b",")]
        return _list(count, values if len(values) == count else None)

    def socket_read_line(self, socket_name: Value = _NAME, timeout: Value = _READ) -> Reading[str]:
        """Without its end; empty when none came."""
        line = yield from self._until(_line, socket_name, timeout)
        return "" if line is None else line.rstrip(b"\r").decode("utf-8", "replace")

    def socket_read_string(
        self,
        socket_name: Value = _NAME,
        prefix: Value = "",
        suffix: Value = "",
        interpret_escape: Value = False,
        timeout: Value = _READ,
    ) -> Reading[str]:
        """What lies between prefix and suffix; without them, what has come."""
        found = _between(text(prefix).encode(), text(suffix).encode())
        got = yield from self._until(found, socket_name, timeout)
        return "" if got is None else got.decode("utf-8", "replace")

    def _send(self, payload: bytes, socket_name: Value) -> bool:
        return self._port.sockets.send(text(socket_name), payload)

    def _until(
        self, find: Callable[[bytes], tuple[bytes, int] | None], socket_name: Value, timeout: Value
    ) -> Reading[bytes | None]:
        """What `find` makes of the bytes that came; None after the time-out or without a peer."""
        sockets, name, seconds = self._port.sockets, text(socket_name), number(timeout)
        deadline = self._port.t + seconds * 1e9 if seconds > 0.0 else math.inf
        while True:
            found = find(sockets.unread(name))
            if found is not None:
                sockets.take(name, found[1])
                return found[0]
            if not sockets.connected(name) or self._port.t >= deadline:
                # A failing read in a loop is no infinite loop on the robot.
                yield
                return None
            yield


def _bytes(size: int) -> Callable[[bytes], tuple[bytes, int] | None]:
    return lambda received: (received[:size], size) if len(received) >= size else None


def _line(received: bytes) -> tuple[bytes, int] | None:
    line, end, _ = received.partition(b"\n")
    return (line, len(line) + 1) if end else None


def _parenthesis(received: bytes) -> tuple[bytes, int] | None:
    found = _FLOATS.search(received)
    return None if found is None else (found[1], found.end())


def _between(prefix: bytes, suffix: bytes) -> Callable[[bytes], tuple[bytes, int] | None]:
    def find(received: bytes) -> tuple[bytes, int] | None:
        start = received.find(prefix)
        if start < 0 or not received:
            return None
        start += len(prefix)
        end = received.find(suffix, start) if suffix else len(received)
        return None if end < 0 else (received[start:end], end + len(suffix))

    return find


def _float(field: bytes) -> float:
    try:
        return float(field)
    except ValueError:
        return math.nan


def _count(value: Value) -> int:
    count = integer(value)
    if 1 <= count <= 30:  # Script Manual: at most 30 values in one call
        return count
    raise ScriptError(f"{count} values at once, allowed are 1 to 30")


def _list(count: int, values: "tuple[int, ...] | list[float] | bytes | None") -> List:
    if values is None:
        return List([0] + [_FAILED] * count)
    return List([count, *values])
