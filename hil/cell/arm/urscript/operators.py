"""URScript's operators: arithmetic on numbers, element by element on lists, an error on the rest.

Integers have 32 bits, like the controller's registers, and overflow is an error. `/` never rounds
and `%` takes the sign of the divisor; the manual does not say, so these are assumptions.
"""

from collections.abc import Iterator
from typing import TypeAlias

from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.values import INT_MAX, INT_MIN, List, Pose, Value, expected, kind

Number: TypeAlias = int | float


def int32(result: Number) -> Number:
    """`result`, if it is a float or an integer of 32 bits."""
    if type(result) is float or INT_MIN <= result <= INT_MAX:
        return result
    raise ScriptError(f"integer overflow: {result} does not fit 32 bits")


def _operand(value: Value, sign: str) -> Number:
    if type(value) is float or type(value) is int:
        return value
    raise ScriptError(f"'{sign}' has no meaning for {kind(value)}")


def _pairs(a: List, b: List) -> Iterator[tuple[Value, Value]]:
    if len(a) != len(b):
        raise ScriptError(f"lists of {len(a)} and {len(b)} elements do not match")
    return zip(a, b, strict=True)


def add(a: Value, b: Value) -> Value:
    if type(a) is float and type(b) is float:
        return a + b
    if isinstance(a, List) and isinstance(b, List):
        return List([add(x, y) for x, y in _pairs(a, b)])
    return int32(_operand(a, "+") + _operand(b, "+"))


def subtract(a: Value, b: Value) -> Value:
    if type(a) is float and type(b) is float:
        return a - b
    if isinstance(a, List) and isinstance(b, List):
        return List([subtract(x, y) for x, y in _pairs(a, b)])
    return int32(_operand(a, "-") - _operand(b, "-"))


def multiply(a: Value, b: Value) -> Value:
    if type(a) is float and type(b) is float:
        return a * b
    if isinstance(a, List):
        return List([multiply(x, b) for x in a])
    if isinstance(b, List):
        return List([multiply(a, x) for x in b])
    return int32(_operand(a, "*") * _operand(b, "*"))


def divide(a: Value, b: Value) -> Value:
    if isinstance(a, List):
        return List([divide(x, b) for x in a])
    dividend, divisor = _operand(a, "/"), _operand(b, "/")
    if divisor == 0:
        raise ScriptError("division by zero")
    return dividend / divisor


def remainder(a: Value, b: Value) -> Value:
    dividend, divisor = _operand(a, "%"), _operand(b, "%")
    if divisor == 0:
        raise ScriptError("division by zero")
    return dividend % divisor


def negate(a: Value) -> Value:
    if isinstance(a, List):
        return List([negate(x) for x in a])
    return int32(-_operand(a, "-"))


def equal(a: Value, b: Value) -> bool:
    return a == b and (type(a) is bool) == (type(b) is bool)


def unequal(a: Value, b: Value) -> bool:
    return not equal(a, b)


def less(a: Value, b: Value) -> bool:
    return _operand(a, "<") < _operand(b, "<")


def less_equal(a: Value, b: Value) -> bool:
    return _operand(a, "<=") <= _operand(b, "<=")


def greater(a: Value, b: Value) -> bool:
    return _operand(a, ">") > _operand(b, ">")


def greater_equal(a: Value, b: Value) -> bool:
    return _operand(a, ">=") >= _operand(b, ">=")


def make_list(*elements: Value) -> List:
    """[...]; a list may hold lists (a matrix), and those hold no further ones."""
    for row in elements:
        if type(row) is List and any(type(x) is List for x in row):
            raise ScriptError("lists nest at most two deep")
    return List(elements)


def make_pose(*elements: Value) -> Pose:
    """p[...]: six numbers, kept as floats."""
    return Pose([float(_operand(x, "p[]")) for x in elements])


def element(value: Value, *indices: Value) -> Value:
    """value[i] or, of a list of lists, value[i, j]; indices count from 0."""
    for index in indices:
        value = _elements(value, index)[_position(value, index)]
    return value


def replaced(value: Value, new: Value, *indices: Value) -> Value:
    """A copy of `value` whose element at `indices` is `new`."""
    first, *rest = indices
    elements, position = _elements(value, first), _position(value, first)
    inner = replaced(elements[position], new, *rest) if rest else new
    if isinstance(elements, Pose):
        return make_pose(*elements[:position], inner, *elements[position + 1 :])
    return make_list(*elements[:position], inner, *elements[position + 1 :])


def _elements(value: Value, index: Value) -> List | Pose:
    if isinstance(value, List | Pose):
        return value
    raise ScriptError(f"{kind(value)} has no element {index}")


def _position(value: Value, index: Value) -> int:
    if type(index) is not int:
        raise expected("an integer index", index)
    size = len(_elements(value, index))
    if not 0 <= index < size:
        raise ScriptError(f"index {index} is outside a list of {size} elements")
    return index
