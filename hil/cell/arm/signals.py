"""Digital and analog I/O of the control box and the tool, and the speed slider."""

from typing import Final

STANDARD: Final = 0
CONFIGURABLE: Final = 8
TOOL: Final = 16


class Signals:
    """digital: bits 0-7 standard, 8-15 configurable, 16-17 tool. analog: V.

    RTDE commands analog outputs as a fraction of their range; the box is taken to be in its 10 V
    mode.
    """

    __slots__ = ("analog_inputs", "analog_outputs", "inputs", "outputs", "speed_fraction")

    FULL_SCALE: Final = 10.0

    def __init__(self) -> None:
        self.inputs = 0
        self.outputs = 0
        self.analog_inputs = [0.0, 0.0]
        self.analog_outputs = [0.0, 0.0]
        self.speed_fraction = 1.0

    def set_input(self, bit: int, on: bool) -> None:
        self.inputs = self.inputs | 1 << bit if on else self.inputs & ~(1 << bit)

    def set_output(self, bit: int, on: bool) -> None:
        self.outputs = self.outputs | 1 << bit if on else self.outputs & ~(1 << bit)

    def drive(self, first: int, mask: int, bits: int) -> None:
        """Set the outputs that `mask` selects, counted from bit `first`."""
        self.outputs = self.outputs & ~(mask << first) | (bits & mask) << first
