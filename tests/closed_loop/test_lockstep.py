import socket
from concurrent.futures import ThreadPoolExecutor
from threading import Event

import pytest

from drivers.errors import RobotStateError
from drivers.ur.connection import RtdeConnection
from hil.app.tap import ignore
from hil.cell.assemble import serve
from hil.cell.errors import DoorError
from hil.cell.serve import ServedCell
from hil_fixtures.testbed import open_testbed

OUTPUTS = ("timestamp", "actual_digital_output_bits")
INPUTS = ("standard_digital_output_mask", "standard_digital_output")


def test_bench_time_stands_still_until_a_command_arrives(rig):
    with open_testbed(rig) as bed:
        state = bed.near.arm.connect()  # leaves one command on the wire
        t = bed.near.arm.read().t
        assert t - state.t == rig.robot.period
        assert bed.cell.served.bench.t == t
        bed.near.arm.hold()
        assert bed.near.arm.read().t == t + rig.robot.period


def test_what_was_said_on_another_port_is_heard_before_the_commands_period(rig):
    with open_testbed(rig) as bed:
        arm, doors = bed.near.arm, bed.cell.doors
        arm.connect()
        arm.read()
        with socket.create_connection((doors.host, doors.ports["dashboard"])) as line:
            line.sendall(b"power off\n")
            arm.hold()
            with pytest.raises(RobotStateError, match="POWER_OFF"):
                arm.read()


@pytest.mark.parametrize("ahead", [False, True])
def test_a_command_that_travels_takes_effect_in_the_same_period_begun_ahead_or_not(rig, ahead):
    bits = [3, 1, 4, 1, 5, 9, 2, 6, 5, 3, 5, 8]
    served = serve(rig, 1, across_processes=False)
    cell = ServedCell(served.bench, served.server, served.gateway, "127.0.0.1", ahead=ahead)
    said = RtdeConnection("127.0.0.1", cell.doors.ports["rtde"], OUTPUTS, INPUTS, 5.0)
    done = Event()
    with cell, ThreadPoolExecutor(1) as pool:
        running = pool.submit(cell.lockstep, done.is_set, ignore)
        try:
            said.open()
            heard = [(said.put(said.pack((0xFF, value))), said.read_newest())[1] for value in bits]
        finally:
            done.set()
            said.close()
        running.result()
    period = rig.robot.period * 1e-9
    # Sent at the end of one period, it travels through the second and acts from the third on.
    expected = [(k + 1) * period for k in range(len(bits))]
    assert [stamp for stamp, _ in heard] == pytest.approx(expected)
    assert [value for _, value in heard] == [0, *bits[:-1]]


def test_a_port_in_use_is_named_and_leaves_no_door_open(rig):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        ports = rig.robot.ports.model_copy(update={"rtde": port})
        robot = rig.robot.model_copy(update={"ports": ports})
        with (
            pytest.raises(DoorError, match=str(port)),
            open_testbed(rig.model_copy(update={"robot": robot})),
        ):
            pass
