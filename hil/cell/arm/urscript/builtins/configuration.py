"""Builtins that configure the robot: tool centre point, payload, watchdog, protective stop."""

from typing import Final

from hil.cell.arm.port import RobotPort
from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.values import List, Value, number, pose6, sequence, text

_ORIGIN: Final = List((0.0, 0.0, 0.0))
_ACTIONS: Final = ("stop", "pause", "ignore")


class Configuration:
    def __init__(self, port: RobotPort) -> None:
        self._port = port

    def set_tcp(self, pose: Value) -> None:
        self._port.set_tcp(pose6(pose))

    def set_payload(self, m: Value, cog: Value = _ORIGIN) -> None:
        """kg, and m in the flange's frame."""
        x, y, z = self._three(cog)
        self._port.set_payload(number(m), (x, y, z))

    def rtde_set_watchdog(
        self, variable_name: Value, min_frequency: Value, action: Value = "pause"
    ) -> None:
        if text(action) not in _ACTIONS:
            raise ScriptError(f"watchdog action {action!r} is none of {', '.join(_ACTIONS)}")
        self._port.watch(text(variable_name), number(min_frequency), text(action))

    def protective_stop(self) -> None:
        self._port.protective_stop("protective_stop() in the program")

    @staticmethod
    def _three(value: Value) -> list[float]:
        elements = sequence(value)
        if len(elements) != 3:
            raise ScriptError(f"three numbers were expected, found {len(elements)}")
        return [number(x) for x in elements]
