"""From the text of a program to code that a runtime can start any number of times."""

from dataclasses import dataclass
from functools import lru_cache
from types import CodeType
from typing import Final

from lark import Token, Tree

from hil.cell.arm.urscript.builtins import builtins
from hil.cell.arm.urscript.builtins.versions import NEWEST, Version
from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.parse import parse
from hil.cell.arm.urscript.scope import ROUTINES, Node, Routine, main_routine, nodes, place
from hil.cell.arm.urscript.statements import module

FILENAME: Final = "<urscript>"
"""Marks the frames of compiled programs in tracebacks."""

UNNAMED: Final = "unnamed"


@dataclass(frozen=True, slots=True)
class Program:
    """A compiled program; a `secondary` one (`sec`) may run beside another."""

    name: str
    secondary: bool
    entry: str
    code: CodeType


@lru_cache(maxsize=32)
def compile_program(text: str, version: Version = NEWEST) -> Program:
    """One `def name(): ... end` (or `sec`), or plain statements; ScriptError when it is wrong.

    version: of the controller's software, which decides what builtins there are.
    Cached by text: clients send the same program again and again, and parsing takes 0.2 s for a
    thousand lines.
    """
    try:
        name, secondary, main = _unit(parse(text))
        code = compile(module(main, builtins(version)), FILENAME, "exec")
    except SyntaxError as error:  # break outside a loop, more than 20 nested loops
        raise ScriptError(error.msg, error.lineno or 0, error.offset or 0) from None
    except (RecursionError, MemoryError):
        raise ScriptError("the program nests too deeply") from None
    return Program(name, secondary, main.symbol, code)


def _unit(tree: Node) -> tuple[str, bool, Routine]:
    """Name, whether secondary, and the main routine."""
    block = tree.children[0]
    assert isinstance(block, Tree)
    trees = list(nodes(block))
    if len(trees) != 1 or trees[0].data not in ROUTINES - {"thread"}:
        _refuse_units(trees)
        return UNNAMED, False, main_routine(block)
    name, parameters, body = trees[0].children
    assert isinstance(name, Token)
    assert isinstance(parameters, Tree)
    assert isinstance(body, Tree)
    if parameters.children:
        raise ScriptError("a program takes no parameters", *place(name))
    return str(name), trees[0].data == "secondary", main_routine(body)


def _refuse_units(trees: list[Node]) -> None:
    """Two programs in one text would silently run neither."""
    if len(trees) > 1 and all(tree.data in ROUTINES for tree in trees):
        raise ScriptError("more than one program in one text", *place(trees[1]))
