import socket

import pytest

from drivers.errors import RobotStateError
from hil.cell.errors import DoorError
from hil_fixtures.testbed import open_testbed


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
