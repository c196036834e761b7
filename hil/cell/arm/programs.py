"""The running program: uploads replace it, a cycle steps it, its errors end it and are logged."""

import re
from typing import Final

from drivers.protocol.rtde_states import RuntimeState
from hil.cell.arm.box import ControlBox
from hil.cell.arm.modes import Event
from hil.cell.arm.port import RobotPort
from hil.cell.arm.urscript import Program, Runtime, RuntimeStatus, ScriptError, compile_program

_SECONDARY: Final = re.compile(r"\A\s*sec\b")


class Programs:
    """One primary program, which may move the arm, and secondary ones beside it."""

    __slots__ = ("_box", "_port", "_primary", "_secondary")

    def __init__(self, box: ControlBox, port: RobotPort) -> None:
        self._box = box
        self._port = port
        self._primary: Runtime | None = None
        self._secondary: list[Runtime] = []

    def upload(self, text: str) -> None:
        """Compile a unit of URScript and start it in the next cycle; errors go to the log only."""
        secondary = _SECONDARY.match(text) is not None
        try:
            program = compile_program(_SECONDARY.sub("def", text, count=1))
        except ScriptError as error:
            self._box.say(f"program refused: {error}")
            return
        if secondary:
            self._secondary.append(Runtime(program, self._port))
        else:
            self._start(program)

    def step(self) -> None:
        """Run every program for one control cycle."""
        for runtime in tuple(self._secondary):
            if not self._runs_on(runtime):
                self._secondary.remove(runtime)
        primary, modes = self._primary, self._box.modes
        if primary is None:
            return
        if modes.program is RuntimeState.PLAYING and not self._runs_on(primary):
            self._box.post(Event.FINISH)
        if modes.program is RuntimeState.STOPPED:
            self._drop()

    def stop(self) -> None:
        """End the program where it stands."""
        self._box.post(Event.FINISH)
        self._drop()

    def _start(self, program: Program) -> None:
        self._drop()
        if not self._box.post(Event.START):
            modes = self._box.modes
            self._box.say(
                f"program {program.name} refused: robot {modes.robot.name}, "
                f"safety {modes.safety.name}; it needs RUNNING and NORMAL"
            )
            return
        self._primary = Runtime(program, self._port)
        self._box.say(f"program {program.name} started")

    def _drop(self) -> None:
        if self._primary is not None:
            self._primary.stop()
            self._primary = None
            self._box.watchdog.clear()
            self._box.say("program stopped")

    def _runs_on(self, runtime: Runtime) -> bool:
        """Step one runtime; false once it has ended, whatever the reason."""
        status = runtime.step()
        if status is RuntimeStatus.FAILED:
            self._box.say(f"program error: {runtime.error}")
        return status is RuntimeStatus.RUNNING
