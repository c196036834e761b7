"""Dashboard lines and their exact replies."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drivers.protocol.errors import WireError
from drivers.protocol.rtde_states import RobotMode
from hil.cell.arm.controller import ArmController
from hil.cell.arm.dashboard_session import MAX_LINE, DashboardSession
from hil.cell.rig.robot import Robot


def ask(cell, *lines):
    session = DashboardSession(cell.arm)
    reply = session.receive("".join(f"{line}\n" for line in lines).encode(), cell.t)
    return reply.decode().splitlines()


@pytest.mark.parametrize(
    ("line", "reply"),
    [
        ("robotmode", "Robotmode: POWER_OFF"),
        ("safetymode", "Safetymode: NORMAL"),
        ("running", "Program running: false"),
        ("programState", "STOPPED <unnamed>"),
        ("get loaded program", "No program loaded"),
        ("PolyscopeVersion", "URSoftware 3.15.8.106339 (Jun 20 2022)"),
        ("get robot model", "UR5"),
        ("power on", "Powering on"),
        ("power off", "Powering off"),
        ("brake release", "Brake releasing"),
        ("play", "Failed to execute: play"),
        ("pause", "Failed to execute: pause"),
        ("stop", "Stopped"),
        ("load missing.urp", "File not found: missing.urp"),
        ("popup hello there", "showing popup"),
        ("setUserRole programmer", "Setting user role: programmer"),
        ("unlock protective stop", "Protective stop releasing"),
        ("make coffee", "could not understand: 'make coffee'"),
        ("", "could not understand: ''"),
    ],
)
def test_replies_are_exact(cell, line, reply):
    assert ask(cell, line) == [reply]


@pytest.mark.parametrize("line", ["version", "is in remote control", "get operational mode"])
def test_e_series_commands_are_unknown_to_cb3(cell, make_cell, line):
    assert ask(cell, line) == [f"could not understand: '{line}'"]
    e_series = make_cell(model="ur5e", series="e-series", version="5.11.0.108249")
    assert "could not" not in ask(e_series, line)[0]


def test_an_emulated_box_can_be_told_by_its_serial_number(cell):
    (serial,) = ask(cell, "get serial number")
    assert serial.isdigit()
    assert serial.startswith("2000")


def test_dashboard_brings_the_arm_up(cell):
    ask(cell, "power on")
    cell.seconds(1.1)
    assert ask(cell, "robotmode") == ["Robotmode: IDLE"]
    ask(cell, "brake release")
    cell.seconds(1.0)
    assert cell.box.modes.robot is RobotMode.RUNNING


def test_a_protective_stop_is_not_unlocked_within_five_seconds(running):
    running.box.protective_stop("test")
    running.seconds(4.9)
    (reply,) = ask(running, "unlock protective stop")
    assert reply.startswith("Cannot unlock protective stop until 5s after occurrence.")
    running.seconds(0.2)
    assert ask(running, "unlock protective stop", "safetymode") == [
        "Protective stop releasing",
        "Safetymode: NORMAL",
    ]


def test_a_note_reaches_the_log(cell):
    assert ask(cell, "addToLog hello  world") == ["Added log message"]
    assert "hello  world" in cell.log


def test_quit_is_answered_and_closes(cell):
    session = DashboardSession(cell.arm)
    assert session.receive(b"quit\n", 0) == b"Disconnected\n"
    assert session.closing


def test_lines_may_come_in_pieces_and_several_at_once(cell):
    session = DashboardSession(cell.arm)
    stream = b"robotmode\r\nrunning\nsafe"
    pieces = b"".join(session.receive(bytes((byte,)), 0) for byte in stream)
    assert pieces == b"Robotmode: POWER_OFF\nProgram running: false\n"
    assert session.receive(b"tymode\n", 0) == b"Safetymode: NORMAL\n"


def test_a_line_without_an_end_is_bounded(cell):
    session = DashboardSession(cell.arm)
    with pytest.raises(WireError, match="over 4096 bytes"):
        session.receive(b"a" * (MAX_LINE + 1), 0)


@given(data=st.binary(max_size=200))
@settings(deadline=None)
def test_garbage_gets_one_answer_a_line(data):
    session = DashboardSession(ArmController(Robot(), np.random.default_rng(0)))
    assert session.receive(data, 0).count(b"\n") == data.count(b"\n")
