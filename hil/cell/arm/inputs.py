"""RTDE input values on their way into registers and I/O."""

from bisect import insort
from collections.abc import Callable, Mapping
from functools import partial
from operator import itemgetter, setitem
from typing import Final, TypeAlias

from hil.cell.arm.pose import ZERO6
from hil.cell.arm.registers import BITS, COUNT, Registers
from hil.cell.arm.signals import CONFIGURABLE, STANDARD, TOOL, Signals

Values: TypeAlias = Mapping[str, object]

_BANKS: Final = (("standard", STANDARD), ("configurable", CONFIGURABLE), ("tool", TOOL))
_MASKS: Final = frozenset(
    (
        "standard_digital_output_mask",
        "configurable_digital_output_mask",
        "tool_digital_output_mask",
        "standard_analog_output_mask",
        "speed_slider_mask",
    )
)
_ARRIVAL: Final = itemgetter(0)


class InputImage:
    """Applies packages of input values; the last value of each input stays for ever."""

    __slots__ = ("_commands", "_queue", "_setters", "_signals")

    def __init__(self, registers: Registers, signals: Signals) -> None:
        self._signals = signals
        self._commands: dict[str, object] = _idle_commands()
        self._setters = _setters(registers, self._commands)
        self._queue: list[tuple[int, Values]] = []

    def accept(self, values: Values, arrival: int) -> None:
        """Queue one package that reaches the controller at `arrival`, ns."""
        insort(self._queue, (arrival, values), key=_ARRIVAL)

    def take(self, t: int) -> list[Values]:
        """Apply every package that has arrived by t, in order, and return them."""
        queue = self._queue
        if not queue or queue[0][0] > t:
            return []
        due = [values for arrival, values in queue if arrival <= t]
        del queue[: len(due)]
        for values in due:
            self._apply(values)
        return due

    @property
    def external_force_torque(self) -> object:
        return self._commands["external_force_torque"]

    def _apply(self, values: Values) -> None:
        setters = self._setters
        for name, value in values.items():
            setters[name](value)
        if not _MASKS.isdisjoint(values):
            self._drive(values)

    def _drive(self, values: Values) -> None:
        """Act on the masks of this package, with the newest values of what they select."""
        commands, signals = self._commands, self._signals
        for bank, first in _BANKS:
            if f"{bank}_digital_output_mask" in values:
                mask, bits = (commands[f"{bank}_digital_output{tail}"] for tail in ("_mask", ""))
                signals.drive(first, _integer(mask), _integer(bits))
        if "standard_analog_output_mask" in values:
            mask = _integer(commands["standard_analog_output_mask"])
            types = _integer(commands["standard_analog_output_type"])
            for n in (0, 1):
                if mask >> n & 1:
                    ratio = _number(commands[f"standard_analog_output_{n}"])
                    signals.set_analog(n, ratio, voltage=bool(types >> n & 1))
        if values.get("speed_slider_mask"):
            signals.speed_fraction = min(max(_number(commands["speed_slider_fraction"]), 0.0), 1.0)


def _idle_commands() -> dict[str, object]:
    commands: dict[str, object] = dict.fromkeys(_MASKS, 0)
    commands |= dict.fromkeys((f"{bank}_digital_output" for bank, _ in _BANKS), 0)
    commands |= {"standard_analog_output_0": 0.0, "standard_analog_output_1": 0.0}
    commands |= {"standard_analog_output_type": 0b11, "speed_slider_fraction": 1.0}
    return commands | {"external_force_torque": ZERO6}


def _setters(
    registers: Registers, commands: dict[str, object]
) -> dict[str, Callable[[object], None]]:
    """What to do with each input's value; partials of C functions, run for every value."""
    bank = registers.inputs
    setters: dict[str, Callable[..., None]] = {}
    for n in range(COUNT):
        setters[f"input_int_register_{n}"] = partial(setitem, bank.integers, n)
        setters[f"input_double_register_{n}"] = partial(setitem, bank.floats, n)
    for n in range(64, BITS):
        setters[f"input_bit_register_{n}"] = partial(setitem, bank.booleans, n)
    for first in (0, 32):
        setters[f"input_bit_registers{first}_to_{first + 31}"] = partial(bank.set_word, first)
    return setters | {name: partial(setitem, commands, name) for name in commands}


def _integer(value: object) -> int:
    assert isinstance(value, int), value  # by the recipe's types
    return value


def _number(value: object) -> float:
    assert isinstance(value, int | float), value  # by the recipe's types
    return value
