"""One client of the primary, secondary or real-time port: script text in, its stream out."""

import re
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Final

from drivers.protocol.errors import WireError
from hil.cell.arm.controller import ArmController
from hil.cell.arm.modes import Event
from hil.cell.arm.streams.stream import Stream

MAX_UNIT: Final = 1 << 20
"""Ten times the longest script that a known client uploads."""

MAX_REFUSED: Final = 16
"""Refusals of one message: each costs 0.15 ms, and who errs so often speaks another language."""

SHARE: Final = 1 << 12
"""A client's script of 70 kB takes 18 control periods to arrive."""

START_DELAY: Final = 36_000_000
"""From a program's arrival to its first cycle, ns; about 35 ms were reported of real boxes. Without
it a program acts on RTDE inputs that its client had replaced before, by a connection of their own.
"""

_NOISE: Final = re.compile(r'"[^"\n]*"|#.*')
_OPENS: Final = re.compile(r"\b(?:def|sec|thread|if|while|for)\b")
_CLOSES: Final = re.compile(r"\bend\b")


class UnitCutter:
    """Cuts a stream into units: `def ... end`, `sec ... end`, or one line outside of any block."""

    __slots__ = ("_depth", "_lines", "_rest", "_size")

    def __init__(self) -> None:
        self._rest = b""
        self._lines: list[str] = []
        self._depth = 0
        self._size = 0

    def feed(self, data: bytes) -> list[str]:
        """The units that `data` completes; WireError when one grows over MAX_UNIT bytes."""
        *lines, self._rest = (self._rest + data).split(b"\n")
        units = [unit for line in lines if (unit := self._line(line)) is not None]
        if self._size + len(self._rest) > MAX_UNIT:
            raise WireError(f"script of over {MAX_UNIT} bytes without an end")
        return units

    def _line(self, raw: bytes) -> str | None:
        line = raw.decode("utf-8", "replace").rstrip("\r")
        code = _NOISE.sub("", line)
        if not self._lines and not code.strip():
            return None
        self._lines.append(line)
        self._size += len(raw) + 1
        self._depth += len(_OPENS.findall(code)) - len(_CLOSES.findall(code))
        if self._depth > 0:
            return None
        unit = "\n".join(self._lines) + "\n"
        self._lines, self._depth, self._size = [], 0, 0
        return unit


class ScriptSession:
    """closing: never; a client leaves when it likes, and its program runs on.

    lossy: a client that only sends scripts never reads what the port streams (ur_rtde does so).
    """

    closing = False
    lossy = True
    share = SHARE

    def __init__(self, arm: ArmController, stream: Stream) -> None:
        self.greeting = stream.greeting
        self._stream = stream
        self._arm = arm
        self._cutter = UnitCutter()

    def receive(self, data: bytes, t: int) -> bytes:
        """Run what `data` completes; WireError when it is no URScript, or has no end."""
        refused = 0
        for unit in self._cutter.feed(data):
            action = COMMANDS.get(unit.strip())
            if action is not None:
                action(self._arm)
            elif not self._arm.upload(unit, START_DELAY):
                refused += 1
            if refused > MAX_REFUSED:
                raise WireError(f"over {MAX_REFUSED} pieces of one message are no URScript")
        return b""

    def publish(self, step: int) -> bytes:
        """What the port streams in this control step."""
        return self._stream.publish(step)

    def close(self) -> None:
        """Forget a half-sent unit; a running program stays."""
        self._stream.close()


def _posts(event: Event) -> Callable[[ArmController], object]:
    return lambda arm: arm.box.post(event)


COMMANDS: Final[Mapping[str, Callable[[ArmController], object]]] = MappingProxyType(
    {
        "power on": _posts(Event.POWER_ON),
        "power off": _posts(Event.POWER_OFF),
        "set robotmode run": _posts(Event.BRAKE_RELEASE),
        "set unlock protective stop": lambda arm: arm.box.modes.unlock_soon(arm.box.t),
        "stop program": lambda arm: arm.programs.stop(),
    }
)
"""Raw lines that UR's client library sends beside programs."""
