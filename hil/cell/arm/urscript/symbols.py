"""The names that compiled code uses, and the builtins it may call."""

from dataclasses import dataclass
from inspect import Signature
from types import MappingProxyType
from typing import Final

READ: Final = MappingProxyType(
    {
        "digital_in": "get_digital_in", "digital_out": "get_digital_out",
        "analog_in": "get_analog_in", "analog_out": "get_analog_out",
    }
)  # fmt: skip
WRITTEN: Final = MappingProxyType(
    {"digital_out": "set_digital_out", "analog_out": "set_analog_out"}
)
"""The oldest names of the I/O, arrays that python-urx still uses: digital_out[2] = True."""


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
