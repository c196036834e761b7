"""Recipes: values to bytes and back, and what does not fit."""

import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.protocol.errors import WireError
from drivers.protocol.rtde import FieldType, Recipe

doubles = st.floats(allow_nan=False)
scalars = {
    "?": st.booleans(),
    "B": st.integers(0, 2**8 - 1),
    "I": st.integers(0, 2**32 - 1),
    "Q": st.integers(0, 2**64 - 1),
    "i": st.integers(-(2**31), 2**31 - 1),
    "d": doubles,
}


def value_of(field):
    scalar = scalars[field.code]
    return scalar if field.count == 1 else st.tuples(*[scalar] * field.count)


@st.composite
def recipes_with_values(draw):
    types = draw(st.lists(st.sampled_from(FieldType), min_size=1, max_size=15))
    recipe = Recipe([f"v{n}" for n in range(len(types))], types)
    return recipe, draw(st.tuples(*map(value_of, types)))


@given(recipes_with_values())
def test_values_come_back_as_they_were_packed(case):
    recipe, values = case
    body = recipe.pack(values)
    assert len(body) == recipe.size
    assert recipe.unpack(body) == values


@given(recipes_with_values(), st.integers(1, 9))
def test_a_body_of_another_size_is_refused(case, extra):
    recipe, values = case
    body = recipe.pack(values)
    for wrong in (body + bytes(extra), body[:-1]):
        with pytest.raises(WireError, match=f"the recipe has {recipe.size}"):
            recipe.unpack(wrong)


def test_numbers_are_big_endian_and_unaligned():
    recipe = Recipe(("a", "b", "c"), (FieldType.UINT8, FieldType.DOUBLE, FieldType.INT32))
    assert recipe.pack((1, 1.0, -2)) == bytes.fromhex("013ff0000000000000fffffffe")


def test_any_byte_but_zero_is_true():
    assert Recipe(("on",), (FieldType.BOOL,)).unpack(b"\x07") == (True,)


def test_a_vector_alone_stays_a_vector():
    body = struct.pack(">3d", 1.0, 2.0, 3.0)
    assert Recipe(("v",), (FieldType.VECTOR3D,)).unpack(body) == ((1.0, 2.0, 3.0),)


@pytest.mark.parametrize(
    "values",
    [(1,), (1, (0.0,) * 6, 3), (1, (0.0,) * 5), (1, 2.0), ("one", (0.0,) * 6), (256, (0.0,) * 6)],
)
def test_values_that_do_not_fit_are_the_callers_error(values):
    recipe = Recipe(("mask", "pose"), (FieldType.UINT8, FieldType.VECTOR6D))
    with pytest.raises(ValueError, match=r"values|vector"):
        recipe.pack(values)


@pytest.mark.parametrize(("names", "types"), [((), ()), (("a", "b"), (FieldType.BOOL,))])
def test_a_recipe_needs_one_type_a_name(names, types):
    with pytest.raises(ValueError, match="one type a name"):
        Recipe(names, types)
