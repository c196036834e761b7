"""Builtins of mathematics (Script Manual, module urmath)."""

import math
from collections.abc import Callable

from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.operators import int32
from hil.cell.arm.urscript.values import (
    INT_MAX,
    List,
    Value,
    boolean,
    integer,
    number,
    sequence,
)


class Maths:
    """Angles are rad; a domain error ends the program."""

    @staticmethod
    def sin(f: Value) -> float:
        return _defined(math.sin, f)

    @staticmethod
    def cos(f: Value) -> float:
        return _defined(math.cos, f)

    @staticmethod
    def tan(f: Value) -> float:
        return _defined(math.tan, f)

    @staticmethod
    def asin(f: Value) -> float:
        return _defined(math.asin, f)

    @staticmethod
    def acos(f: Value) -> float:
        return _defined(math.acos, f)

    @staticmethod
    def atan(f: Value) -> float:
        return _defined(math.atan, f)

    @staticmethod
    def atan2(x: Value, y: Value) -> float:
        """Arc tangent of x / y: the manual names the opposite side x."""
        return _defined(math.atan2, x, y)

    @staticmethod
    def sqrt(f: Value) -> float:
        return _defined(math.sqrt, f)

    @staticmethod
    def log(b: Value, f: Value) -> float:
        """Logarithm of f to base b."""
        return _defined(math.log, f, b)

    @staticmethod
    def pow(base: Value, exponent: Value) -> float:
        return _defined(math.pow, base, exponent)

    @staticmethod
    def floor(f: Value) -> int:
        return int(int32(_defined(math.floor, f)))

    @staticmethod
    def ceil(f: Value) -> int:
        return int(int32(_defined(math.ceil, f)))

    @staticmethod
    def d2r(d: Value) -> float:
        return math.radians(number(d))

    @staticmethod
    def r2d(r: Value) -> float:
        return math.degrees(number(r))

    @staticmethod
    def norm(a: Value) -> float:
        """Length of a list, magnitude of a number."""
        if isinstance(a, List):
            return math.hypot(*(number(x) for x in a))
        return abs(number(a))

    @staticmethod
    def binary_list_to_integer(l: Value) -> int:  # noqa: E741  # the manual's name
        """Least significant bit first, at most 32 bits."""
        bits = sequence(l)
        if len(bits) > 32:
            raise ScriptError(f"{len(bits)} bits do not fit an integer")
        unsigned = sum(boolean(bit) << i for i, bit in enumerate(bits))
        return unsigned if unsigned <= INT_MAX else unsigned - 2**32

    @staticmethod
    def integer_to_binary_list(x: Value) -> List:
        """The 32 bits, least significant first."""
        return List([bool(integer(x) >> i & 1) for i in range(32)])


def _defined(function: Callable[..., float], *arguments: Value) -> float:
    try:
        return function(*(number(x) for x in arguments))
    except (ValueError, OverflowError, ZeroDivisionError) as error:
        shown = ", ".join(map(str, arguments))
        raise ScriptError(f"{function.__name__}({shown}): {error}") from None
