"""From URScript text to its syntax tree."""

from functools import cache

from lark import Lark, Token, Tree
from lark.exceptions import UnexpectedCharacters, UnexpectedInput, UnexpectedToken

from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.lines import Continuation


@cache
def _parser() -> Lark:
    """The LALR tables, built at the first program (0.1 s) and not when the module is imported."""
    return Lark.open(
        "grammar.lark",
        rel_to=__file__,
        parser="lalr",
        lexer="basic",
        propagate_positions=True,
        maybe_placeholders=True,
        postlex=Continuation(),
    )


def parse(source: str) -> Tree[Token]:
    """The tree of a program, ScriptError at the first character or word out of place."""
    try:
        return _parser().parse(source)
    except UnexpectedInput as error:
        raise ScriptError(_complaint(error), max(error.line, 1), max(error.column, 1)) from None


def _complaint(error: UnexpectedInput) -> str:
    if isinstance(error, UnexpectedCharacters):
        return f"syntax error at {error.char!r}"
    if isinstance(error, UnexpectedToken) and error.token.type != "$END":
        return f"syntax error at {str(error.token)!r}"
    return "syntax error: the program ends too early"
