"""Every reading of RTDEReceiveInterface, held against what the arm is doing."""

import math
import tempfile
import time
from pathlib import Path

from case import Case, Cases
from expect import becomes, equal, near, true_soon
from robot import RUNNING, Robot

ZERO = [0.0] * 6
SPEED = [0.2, 0.0, 0.0, 0.0, 0.0, 0.0]
JOINT_RUNNING = 253
AMBIENT = (0.0, 80.0)
"""Plausible temperature of a joint, °C."""


def vector_of(name: str, low: float, high: float, size: int = 6) -> Case:
    """So many numbers within bounds; for what the emulation holds constant."""

    def check(robot: Robot) -> None:
        found = getattr(robot.receive, name)()
        equal(len(found), size)
        assert all(low <= number <= high for number in found), f"found {found}"

    return Case(check)


def number_of(name: str, low: float, high: float) -> Case:
    def check(robot: Robot) -> None:
        found = getattr(robot.receive, name)()
        assert low <= found <= high, f"found {found}, wanted {low:g} to {high:g}"

    return Case(check)


def at_home(name: str) -> Case:
    """Joint angles at rest are home's."""
    return Case(lambda robot: becomes(getattr(robot.receive, name), robot.home, 1e-3))


def turning(name: str) -> Case:
    """Joint speeds while the base joint turns."""

    def check(robot: Robot) -> None:
        robot.control.speedJ(SPEED, 1.0)
        becomes(getattr(robot.receive, name), SPEED, 5e-3)
        robot.control.speedStop()

    return Case(check)


def rising(name: str) -> Case:
    """TCP speed while the arm rises."""

    def check(robot: Robot) -> None:
        robot.control.speedL([0, 0, 0.05, 0, 0, 0], 0.5)
        becomes(getattr(robot.receive, name), [0, 0, 0.05, 0, 0, 0], 2e-3)
        robot.control.speedStop()

    return Case(check)


def pose(name: str) -> Case:
    """Home's pose by the robot's own kinematics."""

    def check(robot: Robot) -> None:
        becomes(getattr(robot.receive, name), robot.control.getForwardKinematics(), 0.5e-3)

    return Case(check)


def accelerating(robot: Robot) -> None:
    robot.control.speedJ(SPEED, 0.5)
    true_soon(lambda: robot.receive.getTargetQdd()[0] > 0.3, "0.5 rad/s² on the base joint")
    robot.control.speedStop()


def tcp_force(robot: Robot) -> None:
    """Pressing half a millimetre into a plate of 10 N/mm."""
    robot.hover()
    robot.control.zeroFtSensor()
    robot.control.moveL(robot.shifted(z=-4.5e-3), 0.05, 0.5)
    becomes(lambda: [robot.push()], [5.0], 1.0)


def raw_wrench(robot: Robot) -> None:
    """The e-Series' own sensor shows the load too."""
    robot.hover()
    before = robot.receive.getFtRawWrench()
    robot.control.moveL(robot.shifted(z=-4.5e-3), 0.05, 0.5)
    becomes(lambda: [math.dist(robot.receive.getFtRawWrench()[:3], before[:3])], [5.0], 1.0)


def timestamp(robot: Robot) -> None:
    """Runs, in whole control periods."""
    seen = [robot.receive.getTimestamp()]
    end = time.monotonic() + 0.3
    while time.monotonic() < end:
        seen.append(robot.receive.getTimestamp())
        time.sleep(0.001)
    assert seen[-1] > seen[0], "time stood still"
    equal(seen, sorted(seen))
    near([t / robot.step for t in seen], [round(t / robot.step) for t in seen], 1e-4)


def digital_out(robot: Robot) -> None:
    for level in (True, False):
        robot.io.setStandardDigitalOut(6, level)
        true_soon(lambda level=level: robot.receive.getDigitalOutState(6) == level, "output 6")


def output_bits(robot: Robot) -> None:
    robot.io.setStandardDigitalOut(6, True)
    true_soon(lambda: bool(robot.receive.getActualDigitalOutputBits() & 64), "bit 6")
    robot.io.setStandardDigitalOut(6, False)
    true_soon(lambda: not robot.receive.getActualDigitalOutputBits() & 64, "bit 6 off")


def analog_output(channel: int) -> Case:
    """The voltage that was set, 0 to 10 V."""

    def check(robot: Robot) -> None:
        read = getattr(robot.receive, f"getStandardAnalogOutput{channel}")
        robot.io.setAnalogOutputVoltage(channel, 0.25)
        becomes(lambda: [read()], [2.5], 1e-3)

    return Case(check)


def int_register(robot: Robot) -> None:
    """What a program wrote."""
    robot.control.sendCustomScriptFunction("write", "write_output_integer_register(13, 4711)")
    true_soon(lambda: robot.receive.getOutputIntRegister(13) == 4711, "register 13")


def double_register(robot: Robot) -> None:
    robot.control.sendCustomScriptFunction("write", "write_output_float_register(13, 4.25)")
    becomes(lambda: [robot.receive.getOutputDoubleRegister(13)], [4.25], 0.0)


def payload(robot: Robot) -> None:
    robot.control.setPayload(1.1, [0.01, 0.0, 0.02])
    becomes(lambda: [robot.receive.getPayload()], [1.1], 1e-9)
    becomes(robot.receive.getPayloadCog, [0.01, 0.0, 0.02], 1e-9)
    robot.control.setPayload(0.6, [0.0, 0.0, 0.06])


def runtime_state(robot: Robot) -> None:
    """2 PLAYING, 1 STOPPED."""
    true_soon(lambda: robot.receive.getRuntimeState() == 2, "PLAYING")
    robot.control.stopScript()
    true_soon(lambda: robot.receive.getRuntimeState() == 1, "STOPPED")
    robot.restart_script()


def protective(robot: Robot) -> None:
    equal(robot.receive.isProtectiveStopped(), False)
    robot.control.triggerProtectiveStop()
    true_soon(robot.receive.isProtectiveStopped, "protective stop")
    equal(robot.receive.getSafetyMode(), 3)
    equal(robot.receive.getSafetyStatusBits() & 5, 4)
    robot.unlock()
    robot.restart_script()
    equal(robot.receive.getSafetyMode(), 1)


def safety_bits(robot: Robot) -> None:
    equal(robot.receive.getSafetyStatusBits() & 0x7FF, 1)


def slider(robot: Robot) -> None:
    try:
        robot.io.setSpeedSlider(0.5)
        becomes(lambda: [robot.receive.getTargetSpeedFraction()], [0.5], 1e-6)
        becomes(lambda: [robot.receive.getSpeedScalingCombined()], [0.5], 0.01)
    finally:
        robot.io.setSpeedSlider(1.0)
    becomes(lambda: [robot.receive.getTargetSpeedFraction()], [1.0], 1e-6)


def recording(robot: Robot) -> None:
    """A CSV with a row a period: its times step by the period."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "robot.csv"
        equal(robot.receive.startFileRecording(str(path), ["timestamp", "actual_q"]), True)
        time.sleep(0.5)
        equal(robot.receive.stopFileRecording(), True)
        header, *rows = path.read_text().splitlines()
    assert header.startswith("timestamp,actual_q_0"), f"header {header[:40]}"
    assert len(rows) > 10, f"{len(rows)} rows"
    assert all(len(row.split(",")) == 7 for row in rows), "rows of other lengths"


def connected(robot: Robot) -> None:
    equal(robot.receive.isConnected(), True)


def reconnects(robot: Robot) -> None:
    robot.receive.disconnect()
    equal(robot.receive.isConnected(), False)
    equal(robot.receive.reconnect(), True)
    first = robot.receive.getTimestamp()
    true_soon(lambda: robot.receive.getTimestamp() > first, "time running again")


def period(robot: Robot) -> None:
    begin = time.monotonic()
    for _ in range(20):
        start = robot.receive.initPeriod()
        robot.receive.waitPeriod(start)
    assert time.monotonic() - begin >= 0.95 * 20 * robot.step, "periods were too short"


def joint_mode(robot: Robot) -> None:
    equal(robot.receive.getJointMode(), [JOINT_RUNNING] * 6)


CASES: Cases = {
    "getActualQ": at_home("getActualQ"),
    "getTargetQ": at_home("getTargetQ"),
    "getActualQd": turning("getActualQd"),
    "getTargetQd": turning("getTargetQd"),
    "getTargetQdd": Case(accelerating),
    "getActualTCPPose": pose("getActualTCPPose"),
    "getTargetTCPPose": pose("getTargetTCPPose"),
    "getActualTCPSpeed": rising("getActualTCPSpeed"),
    "getTargetTCPSpeed": rising("getTargetTCPSpeed"),
    "getActualTCPForce": Case(tcp_force),
    "getFtRawWrench": Case(raw_wrench, ((4, 0), (5, 9)), lambda robot: robot.receive.getActualQ()),
    "getTimestamp": Case(timestamp),
    "getDigitalOutState": Case(digital_out),
    "getActualDigitalOutputBits": Case(output_bits),
    "getDigitalInState": Case(lambda robot: equal(robot.receive.getDigitalInState(1), False)),
    "getActualDigitalInputBits": number_of("getActualDigitalInputBits", 0, 0x3FFFF),
    "getStandardAnalogOutput0": analog_output(0),
    "getStandardAnalogOutput1": analog_output(1),
    "getStandardAnalogInput0": number_of("getStandardAnalogInput0", 0.0, 10.0),
    "getStandardAnalogInput1": number_of("getStandardAnalogInput1", 0.0, 10.0),
    "getOutputIntRegister": Case(int_register),
    "getOutputDoubleRegister": Case(double_register),
    "getPayload": Case(payload),
    "getPayloadCog": Case(payload),
    "getPayloadInertia": vector_of("getPayloadInertia", -1.0, 10.0),
    "getRobotMode": Case(lambda robot: equal(robot.receive.getRobotMode(), RUNNING)),
    "getRobotStatus": Case(lambda robot: equal(robot.receive.getRobotStatus() & 3, 3)),
    "getRuntimeState": Case(runtime_state),
    "getSafetyMode": Case(lambda robot: equal(robot.receive.getSafetyMode(), 1)),
    "getSafetyStatusBits": Case(safety_bits),
    "isProtectiveStopped": Case(protective),
    "isEmergencyStopped": Case(lambda robot: equal(robot.receive.isEmergencyStopped(), False)),
    "getSpeedScaling": number_of("getSpeedScaling", 0.0, 1.0),
    "getTargetSpeedFraction": Case(slider),
    "getSpeedScalingCombined": Case(slider),
    "getJointMode": Case(joint_mode),
    "getJointTemperatures": vector_of("getJointTemperatures", *AMBIENT),
    "getActualCurrent": vector_of("getActualCurrent", -20.0, 20.0),
    "getTargetCurrent": vector_of("getTargetCurrent", -20.0, 20.0),
    "getTargetMoment": vector_of("getTargetMoment", -400.0, 400.0),
    "getJointControlOutput": vector_of("getJointControlOutput", -20.0, 20.0),
    "getActualJointVoltage": vector_of("getActualJointVoltage", 40.0, 60.0),
    "getActualMainVoltage": number_of("getActualMainVoltage", 40.0, 60.0),
    "getActualRobotVoltage": number_of("getActualRobotVoltage", 40.0, 60.0),
    "getActualRobotCurrent": number_of("getActualRobotCurrent", 0.0, 20.0),
    "getActualMomentum": number_of("getActualMomentum", 0.0, 50.0),
    "getActualToolAccelerometer": vector_of("getActualToolAccelerometer", -20.0, 20.0, 3),
    "getActualExecutionTime": number_of("getActualExecutionTime", 0.0, 1.0),
    "startFileRecording": Case(recording),
    "stopFileRecording": Case(recording),
    "initPeriod": Case(period),
    "waitPeriod": Case(period),
    "isConnected": Case(connected),
    "disconnect": Case(reconnects),
    "reconnect": Case(reconnects),
}
