"""Builtins of force control, contact and hand guiding."""

from typing import Final

from hil.cell.arm.port import ForcePort, RobotPort, Selection
from hil.cell.arm.pose import ZERO6
from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.values import (
    List,
    Pose,
    Value,
    boolean,
    integer,
    number,
    pose6,
    sequence,
    vector3,
    vector6,
)  # fmt: skip

_ORIGIN: Final = List((0.0, 0.0, 0.0))
_EVERY_AXIS: Final = List((1, 1, 1, 1, 1, 1))
_ANY: Final = Pose(ZERO6)
_BASE, _TOOL = "base", "tool"


class Forces:
    """None of these takes robot time: the controller acts on them from this cycle on."""

    def __init__(self, port: RobotPort) -> None:
        self._port = port

    @property
    def _force(self) -> ForcePort:
        return self._port.force

    def force_mode(
        self, task_frame: Value, selection_vector: Value, wrench: Value, type: Value, limits: Value
    ) -> None:
        selection = _selection(selection_vector)
        try:
            self._force.start(
                pose6(task_frame), selection, vector6(wrench), integer(type), vector6(limits)
            )
        except ValueError as error:
            raise ScriptError(str(error)) from None

    def end_force_mode(self) -> None:
        self._force.end()

    def force_mode_set_damping(self, damping: Value) -> None:
        """0..1; more makes the arm slower."""
        self._force.damp(number(damping))

    def force_mode_set_gain_scaling(self, scaling: Value) -> None:
        """0..2; above 1 a stiff contact may become unstable."""
        self._force.scale(number(scaling))

    def zero_ftsensor(self) -> None:
        self._force.zero()

    def ft_rtde_input_enable(
        self,
        enable: Value,
        sensor_mass: Value = 0.0,
        sensor_measuring_offset: Value = _ORIGIN,
        sensor_cog: Value = _ORIGIN,
    ) -> None:
        """The sensor's own mass is taken to be part of the payload, as the manual asks."""
        number(sensor_mass), vector3(sensor_cog)
        self._force.believe(boolean(enable), vector3(sensor_measuring_offset))

    enable_external_ft_sensor = ft_rtde_input_enable  # the old name

    def tool_contact(self, direction: Value = _ANY) -> int:
        """Cycles back to just before contact against motion along `direction`; 0 for none."""
        x, y, z, *_ = vector6(direction)
        return self._force.cycles_since_contact((x, y, z))

    def get_actual_joint_positions_history(self, steps: Value = 0) -> List:
        try:
            return List(self._force.joints_before(integer(steps)))
        except ValueError as error:
            raise ScriptError(str(error)) from None

    def freedrive_mode(self, freeAxes: Value = _EVERY_AXIS, feature: Value = _BASE) -> None:
        """`feature`: "base", "tool", or a pose in the base frame."""
        tcp = self._port.target_tcp_pose()
        if isinstance(feature, Pose):
            frame = pose6(feature)
        elif feature in (_BASE, _TOOL):
            frame = ZERO6 if feature == _BASE else tcp
        else:
            raise ScriptError(f'feature must be "base", "tool" or a pose, found {feature!r}')
        self._force.release(frame, _selection(freeAxes))

    def freedrive_mode_no_incorrect_payload_check(self) -> None:
        """Payload is never checked here."""
        self.freedrive_mode()

    def end_freedrive_mode(self) -> None:
        self._force.end()

    def get_freedrive_status(self) -> int:
        """0: nothing limits the hand. Singularities end the mode by a protective stop instead."""
        return 0

    def teach_mode(self) -> None:
        self.freedrive_mode()

    def end_teach_mode(self) -> None:
        self._force.end()

    def get_tcp_force(self) -> List:
        """N and N·m in the base frame."""
        return List(self._force.wrench())

    def force(self) -> float:
        """Magnitude of the force part of get_tcp_force(), N."""
        x, y, z, *_ = self._force.wrench()
        return float((x * x + y * y + z * z) ** 0.5)


def _selection(value: Value) -> Selection:
    elements = sequence(value)
    if len(elements) != 6:
        raise ScriptError(f"six axes were expected, found {len(elements)}")
    a, b, c, d, e, f = (number(x) != 0.0 for x in elements)
    return (a, b, c, d, e, f)
