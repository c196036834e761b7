"""Cutting a stream of script text into units."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.protocol.errors import WireError
from drivers.protocol.rtde_states import RobotMode
from hil.cell.arm.modes import Event
from hil.cell.arm.script_session import MAX_UNIT, ScriptSession, UnitCutter
from hil.cell.arm.streams.stream import SecondaryStream

PROGRAM = """def motion():
  # if this were code, an end would be missing
  textmsg("while def if")
  thread helper():
    while True:
      if x == 1:
        sync()
      elif x == 2: # comment
        end_force_mode()
      end
    end
  end
end
"""
SECONDARY = "sec signal():\n  set_digital_out(1, True)\nend\n"
LINE = "set_digital_out(0, True)\n"


def test_a_program_is_one_unit():
    assert UnitCutter().feed(PROGRAM.encode()) == [PROGRAM]


def test_units_follow_each_other():
    stream = PROGRAM + "\n\n" + SECONDARY + LINE + "  # note\n" + PROGRAM
    assert UnitCutter().feed(stream.encode()) == [PROGRAM, SECONDARY, LINE, PROGRAM]


@given(st.lists(st.integers(1, 60), max_size=20))
def test_pieces_do_not_matter(cuts):
    stream, cutter, units = (PROGRAM + LINE + SECONDARY).encode(), UnitCutter(), []
    for size in cuts:
        units += cutter.feed(stream[:size])
        stream = stream[size:]
    assert units + cutter.feed(stream) == [PROGRAM, LINE, SECONDARY]


def test_an_unfinished_unit_waits():
    cutter = UnitCutter()
    assert cutter.feed(PROGRAM[:-4].encode()) == []
    assert cutter.feed(b"end\n") == [PROGRAM]


def test_a_unit_without_an_end_is_bounded():
    cutter = UnitCutter()
    with pytest.raises(WireError, match="without an end"):
        cutter.feed(b"def f():\n" + b"x = 1\n" * (MAX_UNIT // 6 + 1))


@given(st.binary(max_size=300))
def test_garbage_is_cut_without_errors(data):
    assert all(isinstance(unit, str) for unit in UnitCutter().feed(data))


def test_raw_commands_reach_the_modes(cell):
    session = ScriptSession(cell.arm, SecondaryStream(cell.box))
    session.receive(b"power on\n", 0)
    assert cell.box.modes.robot is RobotMode.BOOTING
    session.receive(b"set robotmode run\n", 0)
    cell.seconds(2.0)
    assert cell.box.modes.robot is RobotMode.RUNNING
    session.receive(b"power off\n", 0)
    assert cell.box.modes.robot is RobotMode.POWER_OFF


def test_a_protective_stop_is_unlocked_by_script_in_a_moment(running):
    session = ScriptSession(running.arm, SecondaryStream(running.box))
    running.box.post(Event.PROTECTIVE_STOP)
    session.receive(b"set unlock protective stop\n", 0)
    running.seconds(0.1)
    assert not running.box.modes.moving
    running.seconds(0.2)
    assert running.box.modes.moving
