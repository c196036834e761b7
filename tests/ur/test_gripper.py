"""The gripper on an arm that remembers its outputs."""

import pytest

from drivers.interfaces import ArmState, RobotMode, SafetyMode
from drivers.ur.gripper import DigitalGripper

ZERO = (0.0,) * 6


class OutputsOnly:
    def __init__(self):
        self.set = []

    def set_output(self, bit, on):
        self.set.append((bit, on))


def test_the_jaws_follow_one_output():
    arm = OutputsOnly()
    gripper = DigitalGripper(arm, output_bit=3, input_bit=0)
    gripper.close()
    gripper.open()
    assert arm.set == [(3, True), (3, False)]


@pytest.mark.parametrize(("inputs", "held"), [(0b100, True), (0b111, True), (0b011, False)])
def test_one_input_says_that_a_part_is_held(inputs, held):
    state = ArmState(
        0, ZERO, ZERO, ZERO, ZERO, RobotMode.RUNNING, SafetyMode.NORMAL, True, inputs, 0
    )
    assert DigitalGripper(OutputsOnly(), output_bit=0, input_bit=2).holds(state) is held
