"""What clients of the primary, secondary and real-time port are sent."""

import pytest

from drivers.protocol.primary import Cutter, PackageType
from drivers.protocol.primary_messages import (
    ErrorCode,
    Key,
    RuntimeException,
    SafetyModeChange,
    Text,
    Version,
    decode_message,
)
from drivers.protocol.primary_state import StateType, decode_state
from drivers.protocol.realtime import Record
from drivers.protocol.rtde_states import RobotMode, SafetyMode
from hil.cell.arm.kinematics import Kinematics
from hil.cell.arm.script_session import ScriptSession
from hil.cell.arm.streams.dh import table
from hil.cell.arm.streams.stream import PrimaryStream, RealtimeStream, SecondaryStream

PROGRAM = 'def hello():\n  textmsg("hi")\n  sync()\nend\n'
E_SERIES = {"model": "ur5e", "series": "e-series", "version": "5.11.0.108249"}


class Listener:
    """Steps a cell and keeps what its stream sends."""

    def __init__(self, cell, stream):
        self.cell, self.stream, self.packages, self._cutter = cell, stream, [], Cutter()

    def run(self, cycles):
        for _ in range(cycles):
            self.cell.run()
            data = self.stream.publish(self.cell.t // self.cell.box.period)
            self.packages += self._cutter.feed(data)
        return self

    @property
    def states(self):
        found = [p for p in self.packages if p.type == PackageType.ROBOT_STATE]
        return [decode_state(package.body) for package in found]

    @property
    def messages(self):
        found = [p for p in self.packages if p.type == PackageType.ROBOT_MESSAGE]
        return [decode_message(package.body)[1] for package in found]


@pytest.fixture
def primary(running):
    return Listener(running, PrimaryStream(running.box))


def test_the_first_word_is_the_version(cell):
    (package,) = Cutter().feed(SecondaryStream(cell.box).greeting)
    assert decode_message(package.body)[1] == Version((3, 15, 8, 106339), "20-06-2022, 10:00:00")


@pytest.mark.parametrize("changes", [{}, E_SERIES])
def test_states_come_ten_times_a_second(make_cell, changes):
    cell = make_cell(**changes)
    listener = Listener(cell, SecondaryStream(cell.box))
    cycles = 2_000_000_000 // cell.box.period
    assert len(listener.run(1).run(cycles).states) == 1 + 20


def test_what_never_changes_comes_once(cell):
    first, *others = Listener(cell, SecondaryStream(cell.box)).run(100).states
    assert {StateType.KINEMATICS, StateType.CONFIGURATION} <= set(first)
    assert all(StateType.KINEMATICS not in state for state in others)


def test_only_the_e_series_tells_of_its_tools_serial_line(cell, make_cell):
    e_series = make_cell(**E_SERIES)
    (cb3,), (e) = (Listener(c, SecondaryStream(c.box)).run(1).states for c in (cell, e_series))
    assert StateType.TOOL_COMMUNICATION not in cb3
    assert StateType.TOOL_COMMUNICATION in e[0]


def test_a_state_tells_where_the_arm_is_and_in_which_mode(primary):
    (state,) = primary.run(1).states
    box = primary.cell.box
    assert state[StateType.JOINTS][0::8] == box.measured.q
    assert state[StateType.JOINTS][1::8] == box.servo.q
    assert state[StateType.CARTESIAN][:6] == box.measured.pose
    timestamp, connected, enabled, powered, emergency, protective, *_ = state[StateType.ROBOT_MODE]
    assert (connected, enabled, powered, emergency, protective) == (1, 1, 1, 0, 0)
    assert timestamp == box.t
    assert state[StateType.ROBOT_MODE][8] == RobotMode.RUNNING


def test_a_program_is_told_from_start_to_end(primary):
    primary.cell.arm.upload(PROGRAM)
    assert primary.run(5).messages == [
        Key("PROGRAM_XXX_STARTED", "hello"),
        Text("hi"),
        Key("PROGRAM_XXX_STOPPED", "hello"),
    ]


def test_an_unknown_function_is_told_with_its_place(primary):
    primary.cell.arm.upload("def f():\n  nothing_of_the_kind()\nend\n")
    expected = RuntimeException(2, 3, "compile_error_name_not_found:nothing_of_the_kind:")
    assert primary.run(1).messages == [expected]


def test_a_protective_stop_is_told_with_its_state_at_once(primary):
    primary.run(2)
    before = len(primary.states)
    primary.cell.box.protective_stop("C207A0: fieldbus input disconnected")
    primary.run(1)
    error, safety = sorted(primary.messages, key=lambda m: isinstance(m, SafetyModeChange))
    assert isinstance(error, ErrorCode)
    assert (error.code, error.argument) == (207, 0)
    assert safety == SafetyModeChange(SafetyMode.PROTECTIVE_STOP)
    (state,) = primary.states[before:]
    assert state[StateType.ROBOT_MODE][5]


def test_a_client_that_has_left_is_not_written_to(running):
    session = ScriptSession(running.arm, stream := PrimaryStream(running.box))
    session.close()
    running.arm.upload(PROGRAM)
    assert Listener(running, stream).run(5).messages == []


def test_an_unread_clients_messages_are_bounded(running):
    stream = PrimaryStream(running.box)
    for n in range(1000):
        running.arm.port.message(str(n))
    messages = Listener(running, stream).run(1).messages
    assert len(messages) == 256
    assert messages[-1] == Text("999")


@pytest.mark.parametrize("changes", [{}, E_SERIES])
def test_the_realtime_port_sends_a_record_every_cycle(make_cell, changes):
    cell = make_cell(**changes)
    stream = RealtimeStream(cell.box)
    cell.run(3)
    found = Record(cell.box.version).unpack(stream.publish(3))
    assert found["q_actual"] == cell.box.measured.q
    assert found["time"] == (cell.box.seconds,)
    assert found["robot_mode"] == (float(RobotMode.POWER_OFF),)
    assert found["payload_mass"] == (cell.box.tool.mass,)


def test_the_dh_table_is_that_of_the_model():
    a, d, _, _ = table(Kinematics("ur5"))
    assert a == pytest.approx((0, -0.425, -0.39225, 0, 0, 0))
    assert d == pytest.approx((0.089159, 0, 0, 0.10915, 0.09465, 0.0823))


def test_checksums_differ_between_models():
    tables = [table(Kinematics(model)) for model in ("ur3", "ur5", "ur5e", "ur10")]
    assert len({found.checksums for found in tables}) == len(tables)
