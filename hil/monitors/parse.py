"""Text to formula; what is wrong is said in one line, with the column."""

from functools import cache
from importlib.resources import files
from typing import Final

from lark import Lark, Token, Transformer, v_args
from lark.exceptions import UnexpectedInput, VisitError

from hil.monitors.errors import MonitorError
from hil.monitors.formula import (
    And,
    Comparison,
    Formula,
    Historically,
    Linear,
    Once,
    Or,
    Window,
    combined,
    negated,
)

MAX_LENGTH: Final = 1000
"""Ten times the longest in use; each of its operators is a nested call in every step."""


def parse(text: str) -> Formula:
    """The formula in `text`; raises MonitorError."""
    if len(text) > MAX_LENGTH:
        raise MonitorError(f"a formula of {len(text)} characters, allowed are {MAX_LENGTH}")
    try:
        tree = _grammar().parse(text)
        formula: Formula = _Tree().transform(tree)
    except UnexpectedInput as error:
        raise MonitorError(_where(text, error)) from None
    except VisitError as error:
        raise MonitorError(f"'{text}': {error.orig_exc}") from None
    except RecursionError:
        raise MonitorError("the formula nests too deeply") from None
    return formula


@cache
def _grammar() -> Lark:
    text = files(__package__).joinpath("grammar.lark").read_text("utf-8")
    return Lark(text, parser="lalr", maybe_placeholders=True)


def _where(text: str, error: UnexpectedInput) -> str:
    token = getattr(error, "token", None)
    ended = token is not None and token.type == "$END"
    column = 0 if ended else getattr(error, "column", 0)
    found = f"'{text[column - 1 :]}' at column {column}" if column > 0 else "its end"
    return (
        f"'{text}': cannot go on at {found}; a formula compares signals (fz <= 10) and joins them "
        "with and, or, not, ->, once[a:b], historically[a:b], previously"
    )


@v_args(inline=True)
class _Tree(Transformer[Token, Formula]):
    """Builds the formula bottom up."""

    def implication(self, left: Formula, right: Formula | None) -> Formula:
        return left if right is None else Or((negated(left), right))

    def disjunction(self, *parts: Formula) -> Formula:
        return Or(parts)

    def conjunction(self, *parts: Formula) -> Formula:
        return And(parts)

    def negation(self, of: Formula) -> Formula:
        return negated(of)

    def historically(self, window: Window | None, of: Formula) -> Formula:
        return Historically(of, window or Window())

    def once(self, window: Window | None, of: Formula) -> Formula:
        return Once(of, window or Window())

    def previously(self, of: Formula) -> Formula:
        return Once(of, Window(1, 1))

    def window(self, near: Token, far: Token) -> Window:
        if int(near) > int(far):
            raise ValueError(f"window [{near}:{far}] is empty; write [{far}:{near}]")
        return Window(int(near), int(far))

    def comparison(self, left: Linear, relation: Token, right: Linear) -> Formula:
        low, high = (left, right) if relation.startswith("<") else (right, left)
        return Comparison(combined(high, low, -1.0), strict=not relation.endswith("="))

    def plus(self, left: Linear, right: Linear) -> Linear:
        return combined(left, right, 1.0)

    def minus(self, left: Linear, right: Linear) -> Linear:
        return combined(left, right, -1.0)

    def times(self, factor: Token, of: Linear) -> Linear:
        return combined(Linear(0.0, ()), of, float(factor))

    def number(self, token: Token) -> Linear:
        return Linear(float(token), ())

    def signal(self, token: Token) -> Linear:
        return Linear(0.0, ((1.0, str(token)),))

    def magnitude(self, of: Linear) -> Linear:
        return Linear(0.0, ((1.0, of),))

    def opposite(self, of: Linear) -> Linear:
        return combined(Linear(0.0, ()), of, -1.0)
