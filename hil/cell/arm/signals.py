"""Digital and analog I/O of the control box and the tool, and the speed slider."""

from typing import Final

STANDARD: Final = 0
CONFIGURABLE: Final = 8
TOOL: Final = 16

VOLTS: Final = (0.0, 10.0)
AMPERES: Final = (0.004, 0.020)
"""Ranges of an analog output in its two modes."""

ON_WHEN_STOPPED: Final = 2
ON_WHILE_RUNNING: Final = 3


class Signals:
    """digital: bits 0-7 standard, 8-15 configurable, 16-17 tool. analog: V, or A for currents.

    analog_types: bits of input 0, input 1, output 0, output 1; set for a voltage, clear for a
    current. tool_analog_types: of the tool's inputs. flags: 32 bits that programs leave each other.
    runstates: what a digital output does when a program starts and stops (Script Manual,
    set_runstate_standard_digital_output_to_value): 0 nothing, 1 is low when stopped, 2 is high when
    stopped, 3 is high while it runs and low after.
    """

    __slots__ = (
        "analog_inputs", "analog_outputs", "analog_types", "flags", "inputs", "outputs",
        "runstates", "speed_fraction", "tool_analog_inputs", "tool_analog_types", "tool_mode",
        "tool_output_modes", "tool_voltage",
    )  # fmt: skip

    def __init__(self) -> None:
        self.inputs = 0
        self.outputs = 0
        self.analog_inputs = [0.0, 0.0]
        self.tool_analog_inputs = [0.0, 0.0]
        self.analog_outputs = [0.0, 0.0]
        self.analog_types = 0b1111
        self.speed_fraction = 1.0
        self.tool_voltage = 0
        self.tool_analog_types = 0b11
        self.tool_mode = 0
        self.tool_output_modes = [0, 0]
        self.flags = 0
        self.runstates: dict[int, int] = {}

    def set_input(self, bit: int, on: bool) -> None:
        self.inputs = self.inputs | 1 << bit if on else self.inputs & ~(1 << bit)

    def set_output(self, bit: int, on: bool) -> None:
        self.outputs = self.outputs | 1 << bit if on else self.outputs & ~(1 << bit)

    def drive(self, first: int, mask: int, bits: int) -> None:
        """Set the outputs that `mask` selects, counted from bit `first`."""
        self.outputs = self.outputs & ~(mask << first) | (bits & mask) << first

    def set_domain(self, n: int, *, voltage: bool) -> None:
        """What analog I/O `n` measures or drives: inputs, outputs, inputs of the tool."""
        types = self.analog_types | self.tool_analog_types << 4
        types = types | 1 << n if voltage else types & ~(1 << n)
        self.analog_types, self.tool_analog_types = types & 0b1111, types >> 4

    def follow(self, *, running: bool) -> None:
        """Set the outputs that follow whether a program runs."""
        for bit, choice in self.runstates.items():
            if running and choice == ON_WHILE_RUNNING:
                self.set_output(bit, on=True)
            elif not running and choice != 0:
                self.set_output(bit, on=choice == ON_WHEN_STOPPED)

    def set_analog(self, n: int, ratio: float, *, voltage: bool) -> None:
        """Drive analog output `n` to this share, 0 to 1, of its range."""
        low, high = VOLTS if voltage else AMPERES
        bit = 1 << (2 + n)
        self.analog_types = self.analog_types | bit if voltage else self.analog_types & ~bit
        self.analog_outputs[n] = low + min(max(ratio, 0.0), 1.0) * (high - low)
