import pytest

from hil.cell.arm.urscript import RuntimeStatus, ScriptError, compile_program


def test_registers_are_read_and_written(robot, run):
    robot.inputs[3] = -7
    robot.float_inputs[4] = 0.25
    run(
        "write_output_integer_register(1, read_input_integer_register(3))\n"
        "write_output_float_register(2, read_input_float_register(4))\n"
        "write_output_boolean_register(5, not read_input_boolean_register(9))\n"
    )
    assert robot.outputs == {1: -7, 2: 0.25, 5: True}


def test_each_group_of_outputs_has_its_bits(robot, run):
    run(
        "set_standard_digital_out(0, True)\nset_configurable_digital_out(1, True)\n"
        "set_tool_digital_out(0, True)\nset_digital_out(9, True)\n"
    )
    assert robot.digital == {0: True, 9: True, 16: True, 17: True}


def test_inputs_are_read_by_group(robot, said):
    robot.digital = {2: True, 16: True}
    program = "textmsg(get_standard_digital_in(2))\ntextmsg(get_configurable_digital_in(2))\n"
    assert said(program + "textmsg(get_tool_digital_in(0))") == ["True", "False", "True"]


@pytest.mark.parametrize(
    "call",
    [
        "read_input_integer_register(48)",
        "read_input_float_register(-1)",
        "write_output_integer_register(0, 1.5)",
        "write_output_float_register(0, True)",
        "set_standard_digital_out(8, True)",
        "set_tool_digital_out(0, 1)",
    ],
)
def test_wrong_address_or_type_ends_the_program(run, call):
    assert run(call).status is RuntimeStatus.FAILED


def test_watchdog_reaches_the_controller(robot, run):
    run('rtde_set_watchdog("input_int_register_0", 10, "stop")')
    assert robot.watched == [("input_int_register_0", 10.0, "stop")]


def test_unknown_watchdog_action_ends_the_program(run):
    assert "panic" in run('rtde_set_watchdog("input_int_register_0", 10, "panic")').error.message


def test_tool_and_payload_are_configured(robot, run):
    run("set_tcp(p[0, 0, 0.12, 0, 0, 0])\nset_payload(0.6, [0, 0, 0.06])\nprotective_stop()")
    assert robot.tcp == (0.0, 0.0, 0.12, 0.0, 0.0, 0.0)
    assert robot.load[:2] == (0.6, (0.0, 0.0, 0.06))
    assert len(robot.stops) == 1


def test_the_oldest_names_of_the_io_are_arrays_unless_the_program_has_one(robot, said):
    program = "digital_out[3] = True\nanalog_out[1] = 0.5\ntextmsg(digital_out[3], analog_out[1])\n"
    assert said(program) == ["True5"]
    assert robot.digital == {3: True}
    assert said("digital_out = [1, 2]\ndigital_out[0] = 7\ntextmsg(digital_out)\n")[-1] == "[7, 2]"


@pytest.mark.parametrize("wrong", ["digital_out[0, 1] = True", "x = analog_in[0, 1]"])
def test_they_have_one_index(wrong):
    with pytest.raises(ScriptError, match="one index was expected"):
        compile_program(wrong)
