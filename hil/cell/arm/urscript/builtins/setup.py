"""Builtins that programs begin with: what PolyScope writes ahead of every program it saves."""

from typing import Final

from hil.cell.arm.port import RobotPort
from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.values import Value, boolean, integer, number, text

_RUNSTATES: Final = 4
"""Keep, low when stopped, high when stopped, high while the program runs and low after."""


class Setup:
    """What an output or the tool's connector is configured for; nothing is plugged in there."""

    def __init__(self, port: RobotPort) -> None:
        self._port = port

    def set_standard_analog_input_domain(self, port: Value, domain: Value) -> None:
        """0: current, 1: voltage."""
        self._port.set_analog_domain(_in(port, 2), voltage=_in(domain, 2) == 1)

    def set_analog_outputdomain(self, port: Value, domain: Value) -> None:
        """0: current, 1: voltage."""
        self._port.set_analog_domain(2 + _in(port, 2), voltage=_in(domain, 2) == 1)

    def set_tool_analog_input_domain(self, port: Value, domain: Value) -> None:
        """0: current, 1: voltage."""
        self._port.set_analog_domain(4 + _in(port, 2), voltage=_in(domain, 2) == 1)

    def set_analog_inputrange(self, port: Value, range: Value) -> None:
        """Deprecated: 0 to 3 mean 5 V, +-5 V, 10 V and +-10 V; nothing is connected."""
        _in(port, 4), _in(range, 4)

    def set_input_actions_to_default(self) -> None:
        """No input has another action here."""

    def set_standard_digital_input_action(self, port: Value, action: Value) -> None:
        _default(_in(port, 8), action)

    def set_configurable_digital_input_action(self, port: Value, action: Value) -> None:
        _default(_in(port, 8), action)

    def set_tool_digital_input_action(self, port: Value, action: Value) -> None:
        _default(_in(port, 2), action)

    def set_gp_boolean_input_action(self, port: Value, action: Value) -> None:
        _default(_in(port, 128), action)

    def set_runstate_standard_digital_output_to_value(self, outputId: Value, state: Value) -> None:
        self._port.set_runstate(_in(outputId, 8), _in(state, _RUNSTATES))

    def set_runstate_configurable_digital_output_to_value(
        self, outputId: Value, state: Value
    ) -> None:
        self._port.set_runstate(8 + _in(outputId, 8), _in(state, _RUNSTATES))

    def set_runstate_tool_digital_output_to_value(self, outputId: Value, state: Value) -> None:
        self._port.set_runstate(16 + _in(outputId, 2), _in(state, _RUNSTATES))

    def set_tool_output_mode(self, mode: Value) -> None:
        """0: digital outputs, 1: dual pin power supply."""
        self._port.set_tool_mode(None, _in(mode, 2))

    def set_tool_digital_output_mode(self, output_id: Value, mode: Value) -> None:
        """1: sinking, 2: sourcing, 3: push and pull."""
        if not 1 <= integer(mode) <= 3:
            raise ScriptError(f"mode {integer(mode)} of a tool output is none of 1, 2, 3")
        self._port.set_tool_mode(_in(output_id, 2), integer(mode))

    def set_tool_communication(  # noqa: PLR0917  # the manual's order
        self,
        enabled: Value,
        baud_rate: Value,
        parity: Value,
        stop_bits: Value,
        rx_idle_chars: Value,
        tx_idle_chars: Value,
    ) -> None:
        """Nobody listens at the tool's serial line here."""
        boolean(enabled), integer(baud_rate), _in(parity, 3), integer(stop_bits)
        number(rx_idle_chars), number(tx_idle_chars)

    def set_safety_mode_transition_hardness(self, type: Value) -> None:
        """0: soft, 1: hard; the emulated arm knows one way to slow down."""
        _in(type, 2)

    def position_deviation_warning(self, enabled: Value, threshold: Value = 0.8) -> None:
        """A line in the box's log before a protective stop; position deviations make none here."""
        boolean(enabled)
        if not 0.0 <= number(threshold) <= 1.0:
            raise ScriptError(f"threshold {number(threshold)} is outside 0..1")

    def powerdown(self) -> None:
        self._port.power_down()


def _in(value: Value, count: int) -> int:
    """A whole number of 0 to count - 1."""
    found = integer(value)
    if 0 <= found < count:
        return found
    raise ScriptError(f"{found} is outside 0..{count - 1}")


def _default(port: int, action: Value) -> None:
    if text(action) != "default":
        raise ScriptError(f"input {port}: action {text(action)!r} is not emulated, only 'default'")
