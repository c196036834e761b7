"""Builtins of time and of what a person would see: sync, sleep, messages."""

from math import ceil

from hil.cell.arm.port import RobotPort
from hil.cell.arm.urscript.builtins.strings import shown
from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.values import Blocking, Value, boolean, number


def cycles(port: RobotPort, seconds: float) -> int:
    """Control cycles that cover `seconds`, at least one; 1 us too long still counts as whole."""
    if not 0.0 <= seconds < 1e9:
        raise ScriptError(f"a time of {seconds} s is impossible")
    return max(1, ceil((seconds * 1e9 - 1e3) / port.period))


class Timing:
    def __init__(self, port: RobotPort) -> None:
        self._port = port

    def get_steptime(self) -> float:
        """Control period, s."""
        return self._port.period * 1e-9

    def random(self) -> float:
        """0..1, from the rig's seed."""
        return self._port.random()

    def sync(self) -> Blocking:
        yield

    def sleep(self, t: Value) -> Blocking:
        for _ in range(cycles(self._port, number(t))):
            yield

    def textmsg(self, s1: Value, s2: Value = "") -> None:
        self._port.message(shown(s1) + shown(s2))

    def popup(
        self,
        s: Value,
        title: Value = "Popup",
        warning: Value = False,
        error: Value = False,
        blocking: Value = False,
    ) -> Blocking:
        """Goes to log and clients; a blocking one waits for ever: nobody stands at the pendant."""
        waits = boolean(blocking)
        self._port.popup(
            shown(s), shown(title), warning=boolean(warning), error=boolean(error), blocking=waits
        )
        yield
        while waits:
            yield
