"""Builtins that configure the robot: tool centre point, payload, watchdog, protective stop."""

from typing import Final

from hil.cell.arm.port import RobotPort
from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.values import (
    List,
    Value,
    integer,
    number,
    pose6,
    text,
    vector3,
    vector6,
)  # fmt: skip

_ORIGIN: Final = List((0.0, 0.0, 0.0))
_TOOL_VOLTAGES: Final = (0, 12, 24)
_ACTIONS: Final = ("stop", "pause", "ignore")


class Configuration:
    def __init__(self, port: RobotPort) -> None:
        self._port = port

    def set_tcp(self, pose: Value) -> None:
        self._port.set_tcp(pose6(pose))

    def set_payload(self, m: Value, cog: Value = _ORIGIN) -> None:
        """kg, and m in the flange's frame."""
        self._port.set_payload(number(m), vector3(cog))

    def set_payload_mass(self, m: Value) -> None:
        """kg; the centre of gravity stays."""
        self._port.set_payload(number(m), self._port.payload()[1])

    def set_payload_cog(self, CoG: Value) -> None:
        """In m in the flange's frame; the mass stays."""
        self._port.set_payload(self._port.payload()[0], vector3(CoG))

    def set_target_payload(
        self,
        m: Value,
        cog: Value,
        inertia: Value = "kept",
        transition_time: Value = 0.0,
    ) -> None:
        """The change is immediate: payload moves nothing here, so there is nothing to smooth."""
        number(transition_time)
        moments = None if inertia == "kept" else vector6(inertia)
        self._port.set_payload(number(m), vector3(cog), moments)

    def get_target_payload(self) -> float:
        """In kg."""
        return self._port.payload()[0]

    def get_target_payload_cog(self) -> List:
        return List(self._port.payload()[1])

    def get_target_payload_inertia(self) -> List:
        """Ixx, Iyy, Izz, Ixy, Ixz, Iyz, kg·m²."""
        return List(self._port.payload()[2])

    def set_gravity(self, d: Value) -> None:
        """m/s², against gravity: [0, 0, 9.82] for an arm that stands upright."""
        self._port.set_gravity(vector3(d))

    def set_tool_voltage(self, voltage: Value) -> None:
        if integer(voltage) not in _TOOL_VOLTAGES:
            raise ScriptError(f"tool voltage {voltage} is none of {_TOOL_VOLTAGES}")
        self._port.set_tool_voltage(integer(voltage))

    def rtde_set_watchdog(
        self, variable_name: Value, min_frequency: Value, action: Value = "pause"
    ) -> None:
        wanted = text(action).lower()  # UR's own example says "PAUSE"
        if wanted not in _ACTIONS:
            raise ScriptError(f"watchdog action {action!r} is none of {', '.join(_ACTIONS)}")
        self._port.watch(text(variable_name), number(min_frequency), wanted)

    def protective_stop(self) -> None:
        self._port.protective_stop("protective_stop() in the program")
