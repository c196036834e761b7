"""Targets of URScript: any text is compiled or refused; a program that runs ends or goes on."""

from contextlib import suppress
from pathlib import Path

import drivers.ur
from fuzz.script_text import Writer
from fuzz.sessions import periods, running_arm
from fuzz.target import Target
from hil.cell.arm.urscript import ScriptError, compile_program

CYCLES = 12
LONGEST = 2000
"""Bytes of choices: a program of some 300 lines."""


def check_compile(octets: bytes) -> None:
    with suppress(ScriptError):
        compile_program(octets.decode("utf-8", "replace"))


def check_run(octets: bytes) -> None:
    """A grammatical program on a running arm; the box must survive it, whatever it does."""
    arm = running_arm()
    arm.upload(Writer(octets[:LONGEST]).program())
    periods(arm, CYCLES)
    arm.programs.stop()
    periods(arm, 1)


_SERVO = (Path(drivers.ur.__file__).parent / "servo.script").read_bytes()

TARGETS = {
    "script": Target(
        check_compile,
        (b"def p():\n x = 1\n while x < 3:\n  x = x + 1\n end\nend\n", b"sync()\n", _SERVO),
        (
            b"end\n",
            b"def f(a=1):\n",
            b"thread t():\n",
            b"elif ",
            b"global ",
            b"p[",
            b"$ 1",
            b"run ",
        ),
    ),
    "script-run": Target(check_run, (bytes(range(256)), bytes(range(255, -1, -1)))),
}
