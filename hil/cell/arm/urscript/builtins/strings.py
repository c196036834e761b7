"""Builtins of strings and lists."""

from math import isfinite
from typing import Final

from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.operators import int32
from hil.cell.arm.urscript.values import List, Pose, Value, integer, sequence, text

MAX_STRING: Final = 1023
"""Longest string, in characters (Script Manual, str_cat)."""


class Strings:
    @staticmethod
    def to_str(val: Value) -> str:
        return _short(shown(val))

    @staticmethod
    def str_cat(op1: Value, op2: Value) -> str:
        return _short(shown(op1) + shown(op2))

    @staticmethod
    def str_len(str: Value) -> int:
        return len(text(str))

    @staticmethod
    def str_empty(str: Value) -> bool:
        return not text(str)

    @staticmethod
    def str_at(src: Value, index: Value) -> str:
        source, i = text(src), integer(index)
        if not 0 <= i < len(source):
            raise ScriptError(f"index {i} is outside a string of {len(source)} characters")
        return source[i]

    @staticmethod
    def str_sub(src: Value, index: Value, len: Value = MAX_STRING) -> str:
        start = integer(index)
        if start < 0:
            raise ScriptError(f"index {start} is negative")
        return text(src)[start : start + integer(len)]

    @staticmethod
    def str_find(src: Value, target: Value, start_from: Value = 0) -> int:
        """Index of `target`, -1 where there is none."""
        return text(src).find(text(target), integer(start_from))

    @staticmethod
    def to_num(str: Value) -> int | float:
        whole = text(str).removeprefix("-").isdecimal()
        try:
            return int32(int(text(str)) if whole else _finite(text(str)))
        except ValueError:
            raise ScriptError(f"{text(str)!r} is not a number") from None

    @staticmethod
    def get_list_length(v: Value) -> int:
        return len(sequence(v))

    length = get_list_length


def _short(text: str) -> str:
    if len(text) > MAX_STRING:
        raise ScriptError(f"a string of {len(text)} characters is longer than {MAX_STRING}")
    return text


def _finite(text: str) -> float:
    value = float(text)
    if not isfinite(value):
        raise ValueError(f"{text} is no finite number")
    return value


def shown(value: Value) -> str:
    """As the controller prints it: floats with six digits, so 1.0 is 1 (Script Manual, to_str)."""
    if type(value) is float:
        return f"{value:g}"
    if isinstance(value, List | Pose):
        elements = ", ".join(shown(x) for x in value)
        return f"p[{elements}]" if isinstance(value, Pose) else f"[{elements}]"
    return "" if value is None else str(value)
