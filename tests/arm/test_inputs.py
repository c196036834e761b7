"""RTDE input values reach registers and I/O, in order and in time."""

import pytest

from drivers.protocol.rtde import FieldType
from drivers.protocol.rtde_variables import INPUTS
from hil.cell.arm.inputs import InputImage
from hil.cell.arm.ownership import FIELDBUS, Ownership
from hil.cell.arm.registers import Registers
from hil.cell.arm.signals import Signals

REGISTER = "input_int_register_3"


@pytest.fixture
def registers():
    return Registers()


@pytest.fixture
def signals():
    return Signals()


@pytest.fixture
def image(registers, signals):
    return InputImage(registers, signals)


def test_values_wait_for_their_arrival(image, registers):
    image.accept({REGISTER: 5}, 100)
    image.take(99)
    assert registers.inputs.integers[3] == 0
    image.take(100)
    assert registers.inputs.integers[3] == 5


def test_the_latest_arrival_wins(image, registers):
    image.accept({REGISTER: 2}, 20)
    image.accept({REGISTER: 1}, 10)
    image.take(50)
    assert registers.inputs.integers[3] == 2


def test_packages_of_one_time_apply_in_the_order_received(image, registers):
    for value in (1, 2, 3):
        image.accept({REGISTER: value}, 10)
    assert [values[REGISTER] for values in image.take(10)] == [1, 2, 3]
    assert registers.inputs.integers[3] == 3


def test_a_mask_selects_the_outputs(image, signals):
    signals.outputs = 0b1010
    image.accept({"standard_digital_output_mask": 0b0110, "standard_digital_output": 0b0101}, 0)
    image.take(0)
    assert signals.outputs == 0b1100


@pytest.mark.parametrize(("bank", "first"), [("configurable", 8), ("tool", 16)])
def test_each_bank_has_its_own_bits(image, signals, bank, first):
    image.accept({f"{bank}_digital_output_mask": 1, f"{bank}_digital_output": 1}, 0)
    image.take(0)
    assert signals.outputs == 1 << first


def test_values_without_a_mask_leave_the_outputs(image, signals):
    image.accept({"standard_digital_output_mask": 0, "standard_digital_output": 255}, 0)
    image.take(0)
    assert signals.outputs == 0


def test_analog_outputs_and_slider_stay_within_their_range(image, signals):
    image.accept(
        {
            "standard_analog_output_mask": 2,
            "standard_analog_output_1": 0.5,
            "speed_slider_mask": 1,
            "speed_slider_fraction": 7.0,
        },
        0,
    )
    image.take(0)
    assert signals.analog_outputs == [0.0, 5.0]
    assert signals.speed_fraction == 1.0


def test_every_input_of_the_table_is_applied(image):
    for name, variable in INPUTS.items():
        value = (0.0,) * 6 if variable.type is FieldType.VECTOR6D else 0
        image.accept({name: value}, 0)
        assert image.take(0)


def test_a_word_of_bits_is_read_back(image, registers):
    image.accept({"input_bit_registers32_to_63": 0x8000_0001}, 0)
    image.take(0)
    assert registers.inputs.word(32) == 0x8000_0001
    assert registers.inputs.word(0) == 0


def test_an_owned_input_is_refused_to_others_until_released():
    owners = Ownership()
    owners.claim(["a", "b"], 1)
    owners.claim(["b"], 1)
    assert owners.conflicts(["a", "c"], 2) == {"a"}
    with pytest.raises(ValueError, match="a"):
        owners.claim(["a", "c"], 2)
    assert not owners.conflicts(["c"], 3)
    owners.release(1)
    owners.claim(["a"], 2)


def test_a_fieldbus_can_hold_registers():
    owners = Ownership()
    owners.claim([REGISTER], FIELDBUS)
    assert owners.conflicts([REGISTER], 1) == {REGISTER}
