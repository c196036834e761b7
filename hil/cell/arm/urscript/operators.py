"""URScript's operators: arithmetic on numbers, element by element on lists, an error on the rest.

Integers have 32 bits, like the controller's registers, and overflow is an error. `/` never rounds
and `%` takes the sign of the divisor; the manual does not say, so these are assumptions.
"""

from collections.abc import Callable, Iterator
from functools import reduce
from typing import TypeAlias, TypeGuard

from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.values import INT_MAX, INT_MIN, List, Pose, Value, expected, kind

Number: TypeAlias = int | float
Operator: TypeAlias = Callable[[Value, Value], Value]


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


def _each(operate: Operator, a: Value, b: Value) -> List:
    """Element by element: two lists of one length, or a list and a number (Script Manual)."""
    if isinstance(a, List) and isinstance(b, List):
        return List([operate(x, y) for x, y in _pairs(a, b)])
    if isinstance(a, List):
        return List([operate(x, b) for x in a])
    assert isinstance(b, List)
    return List([operate(a, y) for y in b])


def add(a: Value, b: Value) -> Value:
    if type(a) is float and type(b) is float:
        return a + b
    if isinstance(a, List) or isinstance(b, List):
        return _each(add, a, b)
    return int32(_operand(a, "+") + _operand(b, "+"))


def subtract(a: Value, b: Value) -> Value:
    if type(a) is float and type(b) is float:
        return a - b
    if isinstance(a, List) or isinstance(b, List):
        return _each(subtract, a, b)
    return int32(_operand(a, "-") - _operand(b, "-"))


def multiply(a: Value, b: Value) -> Value:
    """A matrix times a matrix or an array is their product; the rest goes element by element."""
    if type(a) is float and type(b) is float:
        return a * b
    if _is_matrix(a) and isinstance(b, List):
        return _product(a, b)
    if isinstance(a, List) or isinstance(b, List):
        return _each(multiply, a, b)
    return int32(_operand(a, "*") * _operand(b, "*"))


def divide(a: Value, b: Value) -> Value:
    if isinstance(a, List) or isinstance(b, List):
        return _each(divide, a, b)
    dividend, divisor = _operand(a, "/"), _operand(b, "/")
    if divisor == 0:
        raise ScriptError("division by zero")
    return dividend / divisor


def remainder(a: Value, b: Value) -> Value:
    if isinstance(a, List) or isinstance(b, List):
        return _each(remainder, a, b)
    dividend, divisor = _operand(a, "%"), _operand(b, "%")
    if divisor == 0:
        raise ScriptError("division by zero")
    return dividend % divisor


def _is_matrix(value: Value) -> TypeGuard[List]:
    return isinstance(value, List) and bool(value) and isinstance(value[0], List)


def _product(matrix: List, other: List) -> List:
    """Of a matrix and a matrix, or an array as a column."""
    if _is_matrix(other) and len({len(_row(row)) for row in other}) > 1:
        raise ScriptError("a matrix needs rows of one length")
    columns = list(zip(*map(_row, other), strict=True)) if _is_matrix(other) else [tuple(other)]
    sums = [[_dot(_row(row), column) for column in columns] for row in matrix]
    return List([List(row) for row in sums] if _is_matrix(other) else [row[0] for row in sums])


def _row(value: Value) -> List:
    if isinstance(value, List):
        return value
    raise ScriptError("a matrix needs rows of one length")


def _dot(row: List, column: tuple[Value, ...]) -> Value:
    if len(row) != len(column) or not row:
        raise ScriptError(f"{len(row)} columns do not match {len(column)} rows")
    return reduce(add, (multiply(x, y) for x, y in zip(row, column, strict=True)))


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
