"""What the sensor node does with a command: a table from opcode to action and answer."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, TypeAlias

from drivers.protocol.nrs_can import WIRE_VERSION
from drivers.protocol.nrs_command import (
    RESET_MAGIC,
    TARE_CLEAR,
    TARE_NEGATIVE_OF_CURRENT,
    Command,
    Opcode,
    Reply,
    Result,
)
from hil.cell.errors import CellError, RigError
from hil.cell.rig.sensor import Sensor
from hil.cell.sensor.tare import Tare
from hil.cell.sensor.transducer import RATE, Transducer

Values: TypeAlias = tuple[int, ...]

SERIAL: Final = b"HIL-EMULATED-001"
FIRMWARE: Final = (1, 0, 1)
MAX_CUTOFF: Final = 5000
"""0.1 Hz: half the conversion rate."""
MAX_PERIOD: Final = 200
"""Milliseconds."""
MAX_TARE_SAMPLES: Final = 10_000


class RefusalError(CellError):
    """A command that the node answers with an error code."""

    def __init__(self, result: Result) -> None:
        super().__init__(result.name)
        self.result = result


@dataclass(slots=True)
class Settings:
    """What SAVE keeps over a reset; period in ms, cutoff in 0.1 Hz."""

    period: int
    cutoff: int

    @classmethod
    def of(cls, sensor: Sensor) -> "Settings":
        """What the rig asks for; RigError when the node's commands could not ask for it."""
        period = round(RATE / sensor.rate) if sensor.rate > 0 else 0
        if not 1 <= period <= MAX_PERIOD or abs(period * sensor.rate - RATE) > 1e-6 * RATE:
            raise RigError(f"sensor.rate {sensor.rate:g} Hz is not 1000 Hz / n, n = 1 .. 200")
        cutoff = round(10 * sensor.filter_cutoff)
        if not 0 <= cutoff <= MAX_CUTOFF:
            raise RigError(
                f"sensor.filter_cutoff {sensor.filter_cutoff:g} Hz is not in 0 .. 500 Hz"
            )
        return cls(period, cutoff)


@dataclass(slots=True)
class Operation:
    """What the node is doing; sent counts samples since boot."""

    transmit: bool = False
    sent: int = 0
    gauge_fault: bool = False
    reset_requested: bool = False


class CommandServer:
    """Executes commands; a repeated one (same opcode and seq) is answered again, not done again."""

    def __init__(
        self,
        sensor: Sensor,
        transducer: Transducer,
        settings: Settings,
        answer: Callable[[Reply], None],
    ) -> None:
        self.settings = settings
        self.saved = Settings(settings.period, settings.cutoff)
        self.operation = Operation()
        self.tare = Tare()
        self._full_scale = [round(10 * sensor.range_force)] * 3 + [
            round(10 * sensor.range_torque)
        ] * 3
        self._transducer = transducer
        self._answer = answer
        self._last: Reply | None = None
        self._taring: tuple[int, int] | None = None
        self._actions: dict[int, Callable[[Values], Values]] = {
            Opcode.SET_FILTER: self._set_filter,
            Opcode.TRANSMIT: self._transmit,
            Opcode.SET_PERIOD: self._set_period,
            Opcode.SAVE: self._save,
            Opcode.GET_TARE: self._get_tare,
            Opcode.GET_FULL_SCALE: self._get_full_scale,
            Opcode.GET_SERIAL: self._get_serial,
            Opcode.GET_FIRMWARE: lambda _: (*FIRMWARE, WIRE_VERSION),
            Opcode.RESET: self._reset,
            Opcode.CLEAR_FAULT: self._clear_fault,
        }

    def execute(self, command: Command) -> None:
        """Do what is asked; the answer comes through `answer`, for a tare when it is done."""
        asked = (command.opcode, command.seq)
        if asked == self._taring:
            return
        if self._last is not None and asked == (self._last.opcode, self._last.seq):
            self._answer(self._last)
            return
        try:
            if command.opcode == Opcode.TARE:
                self._begin_tare(command)
            else:
                self._reply(command, Result.OK, self._act(command))
        except RefusalError as refusal:
            self._reply(command, refusal.result)

    def reboot(self) -> None:
        """Forget everything that was not saved."""
        self.settings = Settings(self.saved.period, self.saved.cutoff)
        self._transducer.set_cutoff(self.settings.cutoff / 10)
        self.operation = Operation()
        self.tare = Tare()
        self._last = self._taring = None

    def _act(self, command: Command) -> Values:
        action = self._actions.get(command.opcode)
        if action is None:
            raise RefusalError(Result.UNSUPPORTED)
        return action(command.arguments)

    def _reply(self, command: Command, result: Result, values: Values = ()) -> None:
        self._last = Reply(command.opcode, command.seq, result, values)
        self._answer(self._last)

    def _begin_tare(self, command: Command) -> None:
        mode, samples = command.arguments
        if mode not in (TARE_CLEAR, TARE_NEGATIVE_OF_CURRENT) or samples > MAX_TARE_SAMPLES:
            raise RefusalError(Result.OUT_OF_RANGE)
        if not self.operation.transmit:
            raise RefusalError(Result.WRONG_STATE)
        if self.tare.busy:
            raise RefusalError(Result.BUSY)
        if mode == TARE_CLEAR:
            self.tare.clear()
            self._reply(command, Result.OK, (self.operation.sent & 0xFF,))
            return

        def done(first: int) -> None:
            self._taring = None
            self._reply(command, Result.OK, (first & 0xFF,))

        self._taring = (command.opcode, command.seq)
        self.tare.begin(max(1, samples), done)

    def _set_filter(self, arguments: Values) -> Values:
        (tenths,) = arguments
        if tenths > MAX_CUTOFF:
            raise RefusalError(Result.OUT_OF_RANGE)
        self.settings.cutoff = tenths
        self._transducer.set_cutoff(tenths / 10)
        return (tenths,)

    def _transmit(self, arguments: Values) -> Values:
        (on,) = arguments
        if on not in (0, 1):
            raise RefusalError(Result.OUT_OF_RANGE)
        self.operation.transmit = bool(on)
        if not on:
            self.tare.abandon()
            self._taring = None
        return (on,)

    def _set_period(self, arguments: Values) -> Values:
        (milliseconds,) = arguments
        if not 1 <= milliseconds <= MAX_PERIOD:
            raise RefusalError(Result.OUT_OF_RANGE)
        self.settings.period = milliseconds
        return (milliseconds,)

    def _save(self, _: Values) -> Values:
        self.saved = Settings(self.settings.period, self.settings.cutoff)
        return ()

    def _get_tare(self, arguments: Values) -> Values:
        axis = _index(arguments, 6)
        return (axis, int(self.tare.offset[axis]))

    def _get_full_scale(self, arguments: Values) -> Values:
        axis = _index(arguments, 6)
        return (axis, self._full_scale[axis])

    def _get_serial(self, arguments: Values) -> Values:
        part = _index(arguments, 4)
        return (part, int.from_bytes(SERIAL[4 * part : 4 * part + 4], "little"))

    def _reset(self, arguments: Values) -> Values:
        if arguments != (RESET_MAGIC,):
            raise RefusalError(Result.OUT_OF_RANGE)
        self.operation.reset_requested = True
        return ()

    def _clear_fault(self, _: Values) -> Values:
        self.operation.gauge_fault = False
        return ()


def _index(arguments: Values, count: int) -> int:
    if arguments[0] >= count:
        raise RefusalError(Result.OUT_OF_RANGE)
    return arguments[0]
