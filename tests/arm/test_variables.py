"""Every output variable has a value that its type can carry."""

import pytest

from drivers.protocol.rtde import Recipe
from drivers.protocol.rtde_variables import OUTPUTS
from hil.cell.arm.variables import MODELLED, NOT_MODELLED, readers


def test_every_output_of_the_table_is_readable(running):
    table = readers(running.box)
    for name, variable in OUTPUTS.items():
        Recipe((name,), (variable.type,)).pack((table[name](),))


def test_nothing_is_both_modelled_and_constant():
    assert not MODELLED.keys() & NOT_MODELLED.keys()


def test_readers_show_the_present(running):
    table = readers(running.box)
    before = table["timestamp"]()
    running.run(125)
    assert table["timestamp"]() == pytest.approx(before + 1.0, abs=1e-12)


def test_a_timestamp_is_a_whole_number_of_steps(running):
    read = readers(running.box)["timestamp"]
    for step in range(1, 2000):
        running.box.t = step * running.box.period
        assert round(read() * 1e9) == step * running.box.period


def test_status_bits_tell_power_and_program(cell):
    read = readers(cell.box)["robot_status_bits"]
    assert read() == 0
    cell.release_brakes()
    assert read() == 1
