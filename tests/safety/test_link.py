"""T3 to T12: what the near side, and the program that it put on the robot, do about the link."""

import re
from functools import partial

import pytest

import drivers.ur.rtde_client as rtde_client
from drivers.protocol.rtde import Cutter, Package
from drivers.ur.arm import UrArm
from drivers.ur.program import ServoProgram
from hil.trial.verdict import Verdict
from tests.safety.conftest import assembly

SLOW = partial(pytest.param, marks=pytest.mark.campaign)


def watchdog(patch):
    """The robot's program waits for commands for ever."""
    sound = ServoProgram.text

    def text(self, rate):
        sleeping, changed = re.subn(r"silent >= \d+", "silent >= 1000000", sound(self, rate))
        assert changed
        return sleeping

    patch.setattr(ServoProgram, "text", text)


def ended(trial):
    """The robot's program has stopped the arm by itself."""
    return any("no fresh command" in text for _, text in trial.log)


@pytest.mark.parametrize("direction", ["from_cell", SLOW("to_cell"), SLOW("both")])
def test_an_arm_on_a_stalled_link_stops_by_itself(law, direction):
    law.holds(ended, watchdog, "T3", {"direction": direction}, cycles=60)


@pytest.mark.parametrize("direction", ["to_cell", SLOW("from_cell")])
def test_an_arm_on_a_half_open_link_stops_by_itself(law, direction):
    law.holds(ended, watchdog, "T4", {"direction": direction}, cycles=60)


@pytest.mark.parametrize("kind", ["T3", SLOW("T4")])
def test_a_link_that_is_dead_from_the_start_ends_the_bring_up_without_a_wall_clock_wait(kind):
    trial = assembly(kind, {"direction": "from_cell"}, at="phase: start", after=3)
    assert trial.verdict is Verdict.BLOCKED
    assert "closed the connection" in trial.reason, "else it waited for its own limit of 15 s"


def believing(patch):
    """That states arrive is enough: nobody looks at what they echo."""
    patch.setattr(UrArm, "_mind_echo", lambda self, sample: None)


@pytest.mark.parametrize("kind", ["T4", SLOW("T12")])
def test_a_host_notices_that_its_commands_do_not_arrive_without_the_robots_help(
    law, monkeypatch, kind
):
    def noticed(trial):
        owed = trial.faults[0].detection
        return "answered no command for 0.15 s" in trial.reason and owed and owed < 0.2

    watchdog(monkeypatch)
    law.holds(noticed, believing, kind, at="phase: search", after=3, cycles=60)


@pytest.mark.parametrize("how", ["rst", SLOW("fin")])
def test_an_arm_whose_host_was_cut_off_stops_by_itself(law, how):
    law.holds(ended, watchdog, "T5", {"how": how})


def one_read_one_package(patch):
    """Whatever one receive brings is taken for a whole package."""
    patch.setattr(Cutter, "feed", lambda self, data: [Package(data[-1], data[3:])])


def test_a_job_goes_on_whatever_pieces_its_packages_come_in(law):
    def done(trial):
        return trial.outcome is not None and trial.outcome.kind.value == "inserted"

    law.holds(done, one_read_one_package, "T7", {"size": 7})


def anything_goes(patch):
    """Nobody looks at what the controller says of each field."""
    patch.setattr(rtde_client, "_refuse", lambda *_: None)


def test_a_refused_recipe_is_named_before_anything_moves(law):
    def named(trial):
        return trial.verdict is Verdict.BLOCKED and "not know input_int_register_24" in trial.reason

    law.holds(named, anything_goes, "T10", {"what": "input"}, at="")


def test_an_arm_that_hears_a_slow_client_stops_by_itself(law):
    law.holds(ended, watchdog, "T11", {"rate": 200.0, "buffer": 1024})


def test_an_arm_that_somebody_else_writes_to_stops_by_itself(law):
    law.holds(ended, watchdog, "T12")
