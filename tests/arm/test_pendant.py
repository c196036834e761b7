"""Programs that the dashboard loads and plays, and what the pendant remembers."""

import pytest

from drivers.protocol.rtde_states import RobotMode, RuntimeState, SafetyMode
from hil.cell.arm.dashboard_session import DashboardSession
from hil.cell.arm.modes import Event

WAITING = "def waiting():\n  while True:\n    sync()\n  end\nend\n"


def ask(cell, line):
    return DashboardSession(cell.arm).receive(f"{line}\n".encode(), cell.t).decode().rstrip("\n")


@pytest.fixture
def stocked(make_cell, tmp_path):
    """A running arm with one program in its folder."""
    (tmp_path / "waiting.script").write_text(WAITING)
    cell = make_cell(programs=tmp_path)
    cell.release_brakes()
    return cell


def test_a_loaded_program_is_played_paused_and_stopped(stocked):
    assert ask(stocked, "load waiting.urp") == "Loading program: waiting.urp"
    assert ask(stocked, "get loaded program") == "Loaded program: /programs/waiting.urp"
    assert ask(stocked, "isProgramSaved") == "true waiting.urp"
    for line, reply, state in (
        ("play", "Starting program", "PLAYING"),
        ("pause", "Pausing program", "PAUSED"),
        ("play", "Starting program", "PLAYING"),
        ("stop", "Stopped", "STOPPED"),
    ):
        assert ask(stocked, line) == reply
        stocked.run(2)
        assert ask(stocked, "programState") == f"{state} waiting.urp"


@pytest.mark.parametrize("path", ["/programs/waiting.urp", "/ursim/programs/waiting.urp"])
def test_a_program_may_be_named_with_its_folder(stocked, path):
    assert ask(stocked, f"load {path}") == f"Loading program: {path}"


@pytest.mark.parametrize("path", ["other.urp", "waiting.script", "../waiting.urp", ""])
def test_what_is_not_in_the_folder_is_not_found(stocked, path):
    assert ask(stocked, f"load {path}").startswith("File not found:")
    assert ask(stocked, "get loaded program") == "No program loaded"


def test_the_dashboard_does_not_count_a_program_sent_by_socket(stocked):
    stocked.arm.upload(WAITING)
    stocked.run(2)
    assert stocked.box.modes.program is RuntimeState.PLAYING
    assert ask(stocked, "running") == "Program running: false"
    assert ask(stocked, "programState") == "STOPPED <unnamed>"


def test_a_program_does_not_play_on_an_arm_without_power(make_cell, tmp_path):
    (tmp_path / "waiting.script").write_text(WAITING)
    cell = make_cell(programs=tmp_path)
    ask(cell, "load waiting.urp")
    assert ask(cell, "play") == "Failed to execute: play"


def test_roles_are_remembered_and_wrong_ones_refused(cell):
    assert ask(cell, "setUserRole OPERATOR") == "Setting user role: OPERATOR"
    assert ask(cell, "setUserRole boss") == "Failed setting user role: boss"
    assert ask(cell, "getUserRole") == "OPERATOR"


def test_the_operational_mode_is_held_until_it_is_cleared(make_cell):
    cell = make_cell(model="ur5e", series="e-series", version="5.11.0.108249")
    assert ask(cell, "set operational mode manual") == "Operational mode MANUAL is set"
    assert ask(cell, "get operational mode") == "MANUAL"
    ask(cell, "clear operational mode")
    assert ask(cell, "get operational mode") == "NONE"


def test_a_safeguard_stop_pauses_and_play_goes_on_after_it(stocked):
    stocked.arm.upload(WAITING)
    stocked.run(2)
    stocked.box.post(Event.SAFEGUARD_OPEN)
    assert stocked.box.modes.safety is SafetyMode.SAFEGUARD_STOP
    assert ask(stocked, "play") == "Failed to execute: play"
    stocked.box.post(Event.SAFEGUARD_RESET)
    assert ask(stocked, "play") == "Starting program"
    assert stocked.box.modes.program is RuntimeState.PLAYING


def test_an_emergency_stop_takes_power_until_it_is_reset(running):
    running.box.post(Event.EMERGENCY_STOP)
    assert running.box.modes.robot is RobotMode.POWER_OFF
    ask(running, "power on")
    assert running.box.modes.robot is RobotMode.POWER_OFF
    running.box.post(Event.EMERGENCY_RESET)
    ask(running, "power on")
    assert running.box.modes.robot is RobotMode.BOOTING
