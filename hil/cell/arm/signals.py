"""Digital and analog I/O of the control box and the tool, and the speed slider."""

from typing import Final

STANDARD: Final = 0
CONFIGURABLE: Final = 8
TOOL: Final = 16

VOLTS: Final = (0.0, 10.0)
AMPERES: Final = (0.004, 0.020)
"""Ranges of an analog output in its two modes."""


class Signals:
    """digital: bits 0-7 standard, 8-15 configurable, 16-17 tool. analog: V, or A for currents.

    analog_types: bits of input 0, input 1, output 0, output 1; set for a voltage, clear for a
    current.
    """

    __slots__ = (
        "analog_inputs", "analog_outputs", "analog_types", "inputs", "outputs", "speed_fraction",
        "tool_voltage",
    )  # fmt: skip

    def __init__(self) -> None:
        self.inputs = 0
        self.outputs = 0
        self.analog_inputs = [0.0, 0.0]
        self.analog_outputs = [0.0, 0.0]
        self.analog_types = 0b1111
        self.speed_fraction = 1.0
        self.tool_voltage = 0

    def set_input(self, bit: int, on: bool) -> None:
        self.inputs = self.inputs | 1 << bit if on else self.inputs & ~(1 << bit)

    def set_output(self, bit: int, on: bool) -> None:
        self.outputs = self.outputs | 1 << bit if on else self.outputs & ~(1 << bit)

    def drive(self, first: int, mask: int, bits: int) -> None:
        """Set the outputs that `mask` selects, counted from bit `first`."""
        self.outputs = self.outputs & ~(mask << first) | (bits & mask) << first

    def set_analog(self, n: int, ratio: float, *, voltage: bool) -> None:
        """Drive analog output `n` to this share, 0 to 1, of its range."""
        low, high = VOLTS if voltage else AMPERES
        bit = 1 << (2 + n)
        self.analog_types = self.analog_types | bit if voltage else self.analog_types & ~bit
        self.analog_outputs[n] = low + min(max(ratio, 0.0), 1.0) * (high - low)
