"""The variable tables: complete by count, and dated as clients rely on."""

import pytest

from drivers.protocol.rtde import FieldType, Recipe
from drivers.protocol.rtde_variables import INPUTS, OUTPUTS


def test_tables_hold_every_published_variable():
    # 406 and 175 are the entries of UR's client library, arrays counted one by one.
    assert (len(OUTPUTS), len(INPUTS)) == (406, 175)


@pytest.mark.parametrize("table", [OUTPUTS, INPUTS])
def test_variables_stand_under_their_names(table):
    assert all(name == variable.name for name, variable in table.items())


@pytest.mark.parametrize(
    ("name", "known", "unknown"),
    [
        ("ft_raw_wrench", (5, 9, 0, 1), (5, 8, 9, 1)),
        ("payload", (3, 11, 0, 1), (3, 10, 9, 1)),
        ("payload", (5, 5, 1, 1), (5, 5, 0, 1)),
        ("payload_inertia", (3, 15, 8, 1), (3, 14, 3, 1)),
        ("output_int_register_24", (3, 9, 0, 1), (3, 8, 9, 1)),
        ("actual_current_as_torque", (5, 23, 0, 1), (3, 15, 8, 1)),
    ],
)
def test_a_variable_is_known_from_its_first_version(name, known, unknown):
    assert OUTPUTS[name].known_to(known)
    assert not OUTPUTS[name].known_to(unknown)


def test_the_fieldbus_range_is_older_than_the_upper_one():
    assert INPUTS["input_double_register_23"].known_to((3, 4, 0))
    assert not INPUTS["input_double_register_24"].known_to((3, 4, 0))


def test_input_registers_read_back_with_the_same_type():
    registers = [name for name in INPUTS if "register" in name]
    assert all(OUTPUTS[name].type is INPUTS[name].type for name in registers)


def test_a_captured_recipe_has_its_captured_size():
    # ur_rtde's command recipe 6 (one integer, six doubles) is 52 bytes on the wire.
    names = ["input_int_register_0", *(f"input_double_register_{n}" for n in range(6))]
    assert Recipe(names, [INPUTS[name].type for name in names]).size == 52
    assert OUTPUTS["joint_mode"].type is FieldType.VECTOR6INT32
