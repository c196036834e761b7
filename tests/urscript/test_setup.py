"""What PolyScope writes ahead of programs, as many clients do too."""

import pytest

from hil.cell.arm.urscript import RuntimeStatus, compile_program
from hil.cell.arm.urscript.errors import ScriptError

PREAMBLE = """def saved():
  set_standard_analog_input_domain(0, 1)
  set_standard_analog_input_domain(1, 0)
  set_tool_analog_input_domain(0, 0)
  set_analog_outputdomain(1, 0)
  set_input_actions_to_default()
  set_standard_digital_input_action(3, "default")
  set_runstate_standard_digital_output_to_value(2, 3)
  set_runstate_tool_digital_output_to_value(1, 1)
  set_tool_voltage(24)
  set_safety_mode_transition_hardness(1)
  set_tcp(p[0, 0, 0.1, 0, 0, 0])
  set_payload_mass(1.5)
  set_payload_cog([0, 0, 0.02])
  set_gravity([0.0, 0.0, 9.82])
  position_deviation_warning(True, 0.7)
  set_flag(4, True)
  textmsg(get_flag(4), get_flag(5))
end
"""
TOOL = """def e_series():
  set_tool_communication(False, 115200, 0, 1, 1.5, 3.5)
  set_tool_output_mode(0)
  set_tool_digital_output_mode(0, 1)
end
"""


def test_a_saved_programs_preamble_configures_the_robot(robot, run):
    assert run(PREAMBLE).status is RuntimeStatus.FINISHED
    assert robot.domains == {0: True, 1: False, 4: False, 3: False}
    assert robot.runstates == {2: 3, 17: 1}
    assert robot.load[:2] == (1.5, (0.0, 0.0, 0.02))
    assert robot.messages == ["TrueFalse"]


def test_the_tools_connector_is_configured_on_the_e_series_only(robot, run):
    assert run(TOOL).status is RuntimeStatus.FINISHED
    assert robot.tool_modes == {None: 0, 0: 1}
    with pytest.raises(ScriptError, match="name not found: set_tool_communication"):
        compile_program(TOOL, (3, 15))


@pytest.mark.parametrize(
    "call",
    [
        "set_standard_analog_input_domain(2, 0)",
        "set_runstate_standard_digital_output_to_value(8, 1)",
        "set_runstate_standard_digital_output_to_value(1, 4)",
        'set_standard_digital_input_action(0, "freedrive")',
        "set_tool_digital_output_mode(0, 4)",
        "position_deviation_warning(True, 2)",
        "get_flag(32)",
    ],
)
def test_what_cannot_be_configured_ends_the_program(run, call):
    assert run(call).status is RuntimeStatus.FAILED


def test_power_goes_and_a_number_comes_by_chance(robot, run):
    run("textmsg(random())\npowerdown()")
    assert (robot.messages, robot.off) == (["0.25"], True)
