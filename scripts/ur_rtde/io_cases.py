"""Every call of RTDEIOInterface; the receive interface or a program tells whether it arrived."""

from case import Case, Cases
from expect import becomes, equal, true_soon
from robot import Robot


def digital(call: str, channel: int, bit: int) -> Case:
    """The output goes on and off."""

    def check(robot: Robot) -> None:
        for level in (True, False):
            equal(getattr(robot.io, call)(channel, level), True)
            true_soon(
                lambda level=level: robot.receive.getDigitalOutState(bit) == level, f"bit {bit}"
            )

    return Case(check)


def voltage(robot: Robot) -> None:
    equal(robot.io.setAnalogOutputVoltage(0, 0.5), True)
    becomes(lambda: [robot.receive.getStandardAnalogOutput0()], [5.0], 1e-3)


def current(robot: Robot) -> None:
    """A quarter of 4 to 20 mA."""
    equal(robot.io.setAnalogOutputCurrent(1, 0.25), True)
    becomes(lambda: [robot.receive.getStandardAnalogOutput1()], [0.008], 1e-5)


def slider(robot: Robot) -> None:
    try:
        equal(robot.io.setSpeedSlider(0.4), True)
        becomes(lambda: [robot.receive.getTargetSpeedFraction()], [0.4], 1e-6)
    finally:
        robot.io.setSpeedSlider(1.0)
    becomes(lambda: [robot.receive.getTargetSpeedFraction()], [1.0], 1e-6)


def int_register(robot: Robot) -> None:
    """A program reads it and writes it where the receive interface looks."""
    equal(robot.io.setInputIntRegister(20, 1234), True)
    body = "write_output_integer_register(14, read_input_integer_register(20))"
    robot.control.sendCustomScriptFunction("copy", body)
    true_soon(lambda: robot.receive.getOutputIntRegister(14) == 1234, "register 14")


def double_register(robot: Robot) -> None:
    equal(robot.io.setInputDoubleRegister(20, 12.5), True)
    body = "write_output_float_register(14, read_input_float_register(20))"
    robot.control.sendCustomScriptFunction("copy", body)
    becomes(lambda: [robot.receive.getOutputDoubleRegister(14)], [12.5], 0.0)


def connected(robot: Robot) -> None:
    equal(robot.io.isConnected(), True)


def reconnects(robot: Robot) -> None:
    robot.io.disconnect()
    equal(robot.io.isConnected(), False)
    equal(robot.io.reconnect(), True)
    robot.io.setStandardDigitalOut(4, True)
    true_soon(lambda: robot.receive.getDigitalOutState(4), "output 4")
    robot.io.setStandardDigitalOut(4, False)


CASES: Cases = {
    "setStandardDigitalOut": digital("setStandardDigitalOut", 3, 3),
    "setConfigurableDigitalOut": digital("setConfigurableDigitalOut", 2, 10),
    "setToolDigitalOut": digital("setToolDigitalOut", 1, 17),
    "setAnalogOutputVoltage": Case(voltage),
    "setAnalogOutputCurrent": Case(current),
    "setSpeedSlider": Case(slider),
    "setInputIntRegister": Case(int_register),
    "setInputDoubleRegister": Case(double_register),
    "isConnected": Case(connected),
    "disconnect": Case(reconnects),
    "reconnect": Case(reconnects),
}
