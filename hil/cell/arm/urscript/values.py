"""What a URScript variable can hold, and the checks that a value is what its reader needs.

Lists and poses are immutable here, which gives them the value semantics of URScript for nothing:
assigning an element makes a new list and rebinds the name.
"""

from collections.abc import Generator
from typing import Final, TypeAlias

from hil.cell.arm.pose import Vector3, Vector6
from hil.cell.arm.urscript.errors import ScriptError

INT_MIN: Final = -(2**31)
INT_MAX: Final = 2**31 - 1


class List(tuple["Value", ...]):
    """A URScript list, [a, b, ...]."""

    __slots__ = ()


class Pose(tuple["Value", ...]):
    """A URScript pose, p[x, y, z, rx, ry, rz], m and rad."""

    __slots__ = ()


Value: TypeAlias = bool | int | float | str | List | Pose | None

Blocking: TypeAlias = Generator[None, None, None]
"""A call that uses robot time: it yields once per control cycle."""

_NAMES: Final = {
    bool: "a boolean", int: "an integer", float: "a float", str: "a string",
    List: "a list", Pose: "a pose", type(None): "nothing",
}  # fmt: skip


def kind(value: Value) -> str:
    """How error messages call the type of `value`."""
    return _NAMES[type(value)]


def expected(wanted: str, value: Value) -> ScriptError:
    """The error that says what was needed and what was found."""
    return ScriptError(f"{wanted} was expected, found {kind(value)}")


def number(value: Value) -> float:
    """An int or float, as a float."""
    if type(value) is float:
        return value
    if type(value) is int:
        return float(value)
    raise expected("a number", value)


def integer(value: Value) -> int:
    if type(value) is int:
        return value
    if type(value) is float and value.is_integer() and INT_MIN <= value <= INT_MAX:
        return int(value)
    raise expected("an integer of 32 bits" if type(value) is float else "an integer", value)


def boolean(value: Value) -> bool:
    if type(value) is bool:
        return value
    raise expected("a boolean", value)


def text(value: Value) -> str:
    if type(value) is str:
        return value
    raise expected("a string", value)


def sequence(value: Value) -> tuple[Value, ...]:
    """The elements of a list or pose."""
    if isinstance(value, List | Pose):
        return value
    raise expected("a list", value)


def vector3(value: Value) -> Vector3:
    """Three numbers of a list."""
    elements = sequence(value)
    if len(elements) != 3:
        raise ScriptError(f"three numbers were expected, found {len(elements)}")
    x, y, z = elements
    return (number(x), number(y), number(z))


def vector6(value: Value) -> Vector6:
    """Six numbers of a list or pose."""
    elements = sequence(value)
    if len(elements) != 6:
        raise ScriptError(f"six numbers were expected, found {len(elements)}")
    a, b, c, d, e, f = elements
    return (number(a), number(b), number(c), number(d), number(e), number(f))


def pose6(value: Value) -> Vector6:
    """(x, y, z, rx, ry, rz) of a pose, m and rad."""
    if isinstance(value, Pose):
        return vector6(value)
    raise expected("a pose", value)


def condition(value: Value) -> bool:
    """What `if`, `while` and the logical operators take: a boolean, or a number that is not 0."""
    if type(value) is bool:
        return value
    return number(value) != 0.0
