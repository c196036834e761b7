"""The names that compiled code uses, and the builtins it may call."""

from dataclasses import dataclass
from inspect import Signature


@dataclass(frozen=True, slots=True)
class Builtin:
    """`blocking`: a generator that uses robot time; it yields once per control cycle."""

    symbol: str
    signature: Signature
    blocking: bool


def variable(name: str) -> str:
    """The compiled name of a program's variable or parameter."""
    return f"v_{name}"


def builtin(name: str) -> str:
    """The compiled name of a builtin."""
    return f"b_{name}"


def written(symbol: str) -> str:
    """The program's own name of `symbol`, for messages."""
    return symbol.partition("_")[2]
