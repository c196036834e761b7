"""A program on a robot: one step per control cycle until it ends, fails or is stopped."""

from enum import Enum
from itertools import islice
from types import GeneratorType, TracebackType
from typing import Final

from hil.cell.arm.port import RobotPort
from hil.cell.arm.urscript import operators
from hil.cell.arm.urscript.builtins import bind
from hil.cell.arm.urscript.compile import FILENAME, Program
from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.scheduler import Halt, Scheduler, Slices
from hil.cell.arm.urscript.symbols import written
from hil.cell.arm.urscript.values import condition

STEP_BUDGET: Final = 20_000
"""Loop turns and calls of one cycle, about 5 ms of this interpreter's time; assumed."""

_OPERATORS: Final = (
    "add", "subtract", "multiply", "divide", "remainder", "negate", "equal", "unequal", "less",
    "less_equal", "greater", "greater_equal", "make_list", "make_pose", "element", "replaced",
)  # fmt: skip


FAULTS: Final = (ScriptError, NameError, RecursionError, ValueError, ArithmeticError)
"""What a program's fault raises; the last two come from the robot's side (an index out of range)
and from arithmetic on numbers that are not finite."""


class RuntimeStatus(Enum):
    RUNNING = "running"
    FINISHED = "finished"
    HALTED = "halted"
    STOPPED = "stopped"
    FAILED = "failed"


class Runtime:
    """Runs `program` on `port`; `error` says why when the status is FAILED."""

    def __init__(self, program: Program, port: RobotPort, budget: int = STEP_BUDGET) -> None:
        self.program = program
        self.status = RuntimeStatus.RUNNING
        self.error: ScriptError | None = None
        self._line = 0
        self._scheduler = Scheduler(budget, may_move=not program.secondary)
        names = self._namespace(port)
        exec(program.code, names)
        self._scheduler.run(names[program.entry]())  # type: ignore[operator]  # a generator function

    def _namespace(self, port: RobotPort) -> dict[str, object]:
        scheduler = self._scheduler
        names: dict[str, object] = {name: getattr(operators, name) for name in _OPERATORS}
        names |= bind(port, scheduler.claim)
        names |= {
            "__builtins__": {}, "Halt": Halt, "condition": condition, "spend": scheduler.spend,
            "run": scheduler.run, "kill": scheduler.kill, "join": scheduler.join,
        }  # fmt: skip
        return names

    def step(self) -> RuntimeStatus:
        """One control cycle; does nothing once the program has ended."""
        if self.status is not RuntimeStatus.RUNNING:
            return self.status
        try:
            if not self._scheduler.step():
                self._end(RuntimeStatus.FINISHED, 0)
        except Halt as halt:
            self._end(RuntimeStatus.HALTED, _place(halt.__traceback__)[0])
        except FAULTS as error:
            self.error = _located(error)
            self._end(RuntimeStatus.FAILED, self.error.line)
        return self.status

    def stop(self) -> None:
        """End the program from outside, as the pendant's stop button does."""
        if self.status is RuntimeStatus.RUNNING:
            self._end(RuntimeStatus.STOPPED, self.line)

    @property
    def line(self) -> int:
        """Where the main thread is, or where the program was ended; 0 once it has finished."""
        main = self._scheduler.main
        return _line_of(main.slices) if main is not None else self._line

    def _end(self, status: RuntimeStatus, line: int) -> None:
        self.status = status
        self._line = line
        self._scheduler.close()


def _located(error: Exception) -> ScriptError:
    """The error with the place that the innermost frame of the program was at."""
    where = _place(error.__traceback__)
    if isinstance(error, ScriptError):
        return error.at(*where)
    if isinstance(error, RecursionError):
        return ScriptError("calls nest too deeply", *where)
    if not isinstance(error, NameError):
        return ScriptError(str(error), *where)
    # Only the message bears the name, for locals too: "... variable 'v_x' ...".
    symbol = str(error).split("'")[1]
    return ScriptError(f"{written(symbol)} has no value yet", *where)


def _place(traceback: TracebackType | None) -> tuple[int, int]:
    """Line and column of the innermost frame of the program, (0, 0) if there is none."""
    place = (0, 0)
    while traceback is not None:
        code = traceback.tb_frame.f_code
        if code.co_filename == FILENAME:
            line, _, column, _ = next(islice(code.co_positions(), traceback.tb_lasti // 2, None))
            place = (line or 0, (column or 0) + 1)
        traceback = traceback.tb_next
    return place


def _line_of(slices: Slices) -> int:
    """The line at which the innermost suspended routine of the program waits."""
    line = 0
    inner: object = slices
    while isinstance(inner, GeneratorType) and inner.gi_code.co_filename == FILENAME:
        line = inner.gi_frame.f_lineno if inner.gi_frame is not None else line
        inner = inner.gi_yieldfrom
    return line
