"""A two-jaw gripper on one digital output, with a grip sensor on one digital input."""

from drivers.interfaces import Arm, ArmState


class DigitalGripper:
    """The output closes the jaws; the input says that they hold a part."""

    def __init__(self, arm: Arm, output_bit: int, input_bit: int) -> None:
        self._arm = arm
        self._output = output_bit
        self._input = 1 << input_bit

    def open(self) -> None:
        """Open the jaws with the arm's next command."""
        self._arm.set_output(self._output, False)

    def close(self) -> None:
        """Close the jaws with the arm's next command."""
        self._arm.set_output(self._output, True)

    def holds(self, state: ArmState) -> bool:
        """Whether the jaws sensed a part in this package."""
        return bool(state.inputs & self._input)
