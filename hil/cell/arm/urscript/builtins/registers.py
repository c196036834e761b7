"""Builtins of the RTDE registers and the digital I/O."""

from typing import Final

from hil.cell.arm.port import RobotPort
from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.values import Value, boolean, integer, number

NUMBERS: Final = 48
BITS: Final = 128
ANALOG: Final = 2
FLAGS: Final = 32
"""How many general purpose registers (RTDE Guide), analog I/O and flags of a kind there are."""

_STANDARD, _CONFIGURABLE, _TOOL = (0, 8), (8, 8), (16, 2)
"""First bit and number of bits of each group of digital I/O."""


class Registers:
    def __init__(self, port: RobotPort) -> None:
        self._port = port

    def read_input_integer_register(self, address: Value) -> int:
        return self._port.input_integer(_address(address, NUMBERS))

    def read_input_float_register(self, address: Value) -> float:
        return self._port.input_float(_address(address, NUMBERS))

    def read_input_boolean_register(self, address: Value) -> bool:
        return self._port.input_boolean(_address(address, BITS))

    def read_output_integer_register(self, address: Value) -> int:
        return self._port.written_integer(_address(address, NUMBERS))

    def read_output_float_register(self, address: Value) -> float:
        return self._port.written_float(_address(address, NUMBERS))

    def read_output_boolean_register(self, address: Value) -> bool:
        return self._port.written_boolean(_address(address, BITS))

    def write_output_integer_register(self, address: Value, value: Value) -> None:
        self._port.output_integer(_address(address, NUMBERS), integer(value))

    def write_output_float_register(self, address: Value, value: Value) -> None:
        self._port.output_float(_address(address, NUMBERS), number(value))

    def write_output_boolean_register(self, address: Value, value: Value) -> None:
        self._port.output_boolean(_address(address, BITS), boolean(value))

    def get_standard_digital_in(self, n: Value) -> bool:
        return self._port.digital_input(_bit(n, _STANDARD))

    def get_configurable_digital_in(self, n: Value) -> bool:
        return self._port.digital_input(_bit(n, _CONFIGURABLE))

    def get_tool_digital_in(self, n: Value) -> bool:
        return self._port.digital_input(_bit(n, _TOOL))

    def set_standard_digital_out(self, n: Value, b: Value) -> None:
        self._port.set_digital_output(_bit(n, _STANDARD), boolean(b))

    def set_configurable_digital_out(self, n: Value, b: Value) -> None:
        self._port.set_digital_output(_bit(n, _CONFIGURABLE), boolean(b))

    def set_tool_digital_out(self, n: Value, b: Value) -> None:
        self._port.set_digital_output(_bit(n, _TOOL), boolean(b))

    def get_standard_digital_out(self, n: Value) -> bool:
        return self._port.digital_output(_bit(n, _STANDARD))

    def get_configurable_digital_out(self, n: Value) -> bool:
        return self._port.digital_output(_bit(n, _CONFIGURABLE))

    def get_tool_digital_out(self, n: Value) -> bool:
        return self._port.digital_output(_bit(n, _TOOL))

    def get_standard_analog_in(self, n: Value) -> float:
        """V or A."""
        return self._port.analog_input(_address(n, ANALOG))

    def get_standard_analog_out(self, n: Value) -> float:
        """V or A."""
        return self._port.analog_output(_address(n, ANALOG))

    def set_standard_analog_out(self, n: Value, f: Value) -> None:
        """Share of the output's range, 0..1."""
        self._port.set_analog_output(_address(n, ANALOG), number(f))

    def get_tool_analog_in(self, n: Value) -> float:
        """V or A; nothing is connected to the tool."""
        return self._port.analog_input(ANALOG + _address(n, ANALOG))

    def get_analog_in(self, n: Value) -> float:
        """Deprecated: 0-1 standard, 2-3 tool; V or A."""
        return self._port.analog_input(_address(n, 2 * ANALOG))

    get_analog_out = get_standard_analog_out  # the old names
    set_analog_out = set_standard_analog_out

    def get_flag(self, n: Value) -> bool:
        """Flags outlive the program."""
        return self._port.flag(_address(n, FLAGS))

    def set_flag(self, n: Value, b: Value) -> None:
        self._port.set_flag(_address(n, FLAGS), boolean(b))

    def get_digital_in(self, n: Value) -> bool:
        """Deprecated: 0-7 standard, 8-9 tool."""
        return self._port.digital_input(_deprecated_bit(n))

    def get_digital_out(self, n: Value) -> bool:
        """Deprecated: 0-7 standard, 8-9 tool."""
        return self._port.digital_output(_deprecated_bit(n))

    def set_digital_out(self, n: Value, b: Value) -> None:
        """Deprecated: 0-7 standard, 8-9 tool."""
        self._port.set_digital_output(_deprecated_bit(n), boolean(b))


def _address(value: Value, count: int) -> int:
    address = integer(value)
    if 0 <= address < count:
        return address
    raise ScriptError(f"register {address} is outside 0..{count - 1}")


def _bit(value: Value, group: tuple[int, int]) -> int:
    first, count = group
    bit = integer(value)
    if 0 <= bit < count:
        return first + bit
    raise ScriptError(f"digital I/O {bit} is outside 0..{count - 1}")


def _deprecated_bit(value: Value) -> int:
    bit = integer(value)
    return _bit(bit - 8, _TOOL) if bit >= 8 else _bit(bit, _STANDARD)
