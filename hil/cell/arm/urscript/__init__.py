"""URScript: `compile_program` checks a program, `Runtime` runs it, one step per control cycle."""

from hil.cell.arm.urscript.compile import Program, compile_program
from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.runtime import Runtime, RuntimeStatus

__all__ = ["Program", "Runtime", "RuntimeStatus", "ScriptError", "compile_program"]
