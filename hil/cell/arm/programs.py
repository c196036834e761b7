"""The running program: uploads replace it, a cycle steps it, its errors end it and are logged."""

import re
from typing import Final

from drivers.protocol.primary_messages import Key, RuntimeException
from drivers.protocol.rtde_states import RuntimeState
from hil.cell.arm.box import ControlBox
from hil.cell.arm.modes import Event
from hil.cell.arm.port import RobotPort
from hil.cell.arm.urscript import Program, Runtime, RuntimeStatus, ScriptError, compile_program

MAX_SECONDARY: Final = 16
"""Assumed; each has a share of every control period."""

_UNKNOWN: Final = re.compile(r"name not found: (\w+)")


class Programs:
    """One primary program, which may move the arm, and secondary ones beside it.

    on_pendant: whether the primary one is the program that the pendant loaded, not a client's.
    """

    __slots__ = ("_box", "_due", "_port", "_primary", "_secondary", "on_pendant")

    def __init__(self, box: ControlBox, port: RobotPort) -> None:
        self._box = box
        self._port = port
        self._primary: Runtime | None = None
        self._secondary: list[Runtime] = []
        self._due: tuple[int, Program] | None = None
        self.on_pendant = False

    def upload(self, text: str, delay: int) -> bool:
        """Compile a unit of URScript and start it after `delay` ns; false for a wrong text.

        Errors go to the log and to the primary port's clients.
        """
        program = self._compiled(text)
        if program is None:
            return False
        if program.secondary:
            self._begin_secondary(program)
        elif delay == 0:
            self._start(program)
        else:
            self.stop()
            self._due = (self._box.t + delay, program)
        return True

    def _begin_secondary(self, program: Program) -> None:
        if len(self._secondary) < MAX_SECONDARY:
            self._secondary.append(Runtime(program, self._port))
        else:
            self._box.say(
                f"program {program.name} refused: {MAX_SECONDARY} secondary programs are running"
            )

    def play(self, text: str) -> bool:
        """Start the pendant's program; false when the robot or the text does not allow it."""
        program = self._compiled(text)
        if program is not None:
            self._start(program)
        self.on_pendant = self._primary is not None
        return self.on_pendant

    def _compiled(self, text: str) -> Program | None:
        try:
            return compile_program(text, self._box.version)
        except ScriptError as error:
            self._box.say(f"program refused: {error}")
            self._box.announce(_exception(error))
            return None

    def step(self) -> None:
        """Run every program for one control cycle."""
        for runtime in tuple(self._secondary):
            if not self._runs_on(runtime):
                self._secondary.remove(runtime)
        if self._due is not None and self._box.t >= self._due[0]:
            self._start(self._due[1])
        primary, modes = self._primary, self._box.modes
        if primary is None:
            return
        if modes.program is RuntimeState.PLAYING and not self._runs_on(primary):
            self._box.post(Event.FINISH)
        if modes.program is RuntimeState.STOPPED:
            self._drop()

    def stop(self) -> None:
        """End the program where it stands, and forget one that was about to start."""
        self._due = None
        self._box.post(Event.FINISH)
        self._drop()

    def _start(self, program: Program) -> None:
        self._due = None
        self._drop()
        if not self._box.post(Event.START):
            modes = self._box.modes
            self._box.say(
                f"program {program.name} refused: robot {modes.robot.name}, "
                f"safety {modes.safety.name}; it needs RUNNING and NORMAL"
            )
            return
        self._primary = Runtime(program, self._port)
        self._box.signals.follow(running=True)
        self._box.say(f"program {program.name} started")
        self._box.announce(Key("PROGRAM_XXX_STARTED", program.name))

    def _drop(self) -> None:
        if self._primary is not None:
            self._primary.stop()
            self._box.announce(Key("PROGRAM_XXX_STOPPED", self._primary.program.name))
            self._primary = None
            self.on_pendant = False
            self._box.watchdog.clear()
            self._box.force_mode.reset()
            self._box.sockets.close_all()
            self._box.signals.follow(running=False)
            self._box.say("program stopped")

    def _runs_on(self, runtime: Runtime) -> bool:
        """Step one runtime; false once it has ended, whatever the reason."""
        status = runtime.step()
        if status is RuntimeStatus.FAILED and runtime.error is not None:
            self._box.say(f"program error: {runtime.error}")
            self._box.announce(_exception(runtime.error))
        return status is RuntimeStatus.RUNNING


def _exception(error: ScriptError) -> RuntimeException:
    """The error as clients are told it; the compiler's commonest one in the controller's words."""
    unknown = _UNKNOWN.match(error.message)
    text = f"compile_error_name_not_found:{unknown[1]}:" if unknown else error.message
    return RuntimeException(error.line, error.column, text)
