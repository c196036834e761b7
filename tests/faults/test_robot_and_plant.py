"""Faults of control box, jaws and plant, on a bench driven by hand."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.protocol.rtde_states import RobotMode, SafetyMode
from hil.cell.errors import FaultError
from hil.cell.injection.plant import Shift

POWERED = 240
"""Periods until the brakes are open."""


def powered(faulty, kind, **content):
    bench = faulty(kind, at=POWERED, **content)
    bench.run(POWERED - 10)
    return bench


def test_a_protective_stop_stops_the_box(faulty):
    bench = powered(faulty, "R1")
    bench.run(1)
    assert bench.box.modes.safety is SafetyMode.PROTECTIVE_STOP
    assert bench.stages("R1") == ["armed", "active", "cleared"]


@pytest.mark.parametrize(("category", "periods"), [("0", 1), ("1", 60)])
def test_an_emergency_stop_takes_the_power(faulty, category, periods):
    bench = powered(faulty, "R2", params={"category": category})
    bench.run(periods)
    assert (bench.box.modes.robot is RobotMode.POWER_OFF) is (category == "0")
    bench.run(6)
    assert bench.box.modes.robot is RobotMode.POWER_OFF
    assert bench.box.modes.safety is SafetyMode.ROBOT_EMERGENCY_STOP


def test_speed_scaling_changes_and_comes_back(faulty):
    bench = powered(faulty, "R4", cycles=3, params={"factor": 0.25})
    bench.run(1)
    assert bench.box.signals.speed_fraction == 0.25
    bench.run(3)
    assert bench.box.signals.speed_fraction == 1.0


def test_a_wrong_payload_shows_in_the_arms_force(faulty, sound):
    bench, plain = faulty("R8", params={"mass": "1 kg"}), sound()
    bench.run(3)
    plain.run(3)
    assert bench.box.measured.force[2] - plain.box.measured.force[2] == pytest.approx(-9.81)


def test_a_pose_offset_moves_the_arm_and_not_its_report(faulty, sound):
    bench, plain = faulty("R9", params={"dx": "1 mm", "dy": "0 mm"}), sound()
    bench.run(60)
    plain.run(60)
    moved = bench.bench.truth.stage[0] - plain.bench.truth.stage[0]
    assert moved == pytest.approx(1e-3, abs=1e-5)
    assert bench.box.measured.pose[:3] == pytest.approx(plain.box.measured.pose[:3], abs=1e-5)


@pytest.mark.parametrize("what", ["dead", "half", "late"])
def test_jaws_that_do_not_follow_hold_nothing(faulty, what):
    bench = faulty("G2", params={"what": what, "delay": "0.5 s"})
    bench.output(1)
    bench.run(10)
    assert not bench.box.signals.inputs & 1
    assert bench.stages("G2")[:2] == ["armed", "active"]


def test_a_dropped_part_is_gone(faulty):
    bench = faulty("G1", at=60)
    bench.output(1)
    bench.run(20)
    assert bench.bench.truth.part.name == "FFC1"
    bench.run(40)
    assert "active" in bench.stages("G1")


def test_the_connector_moves_at_its_speed_and_the_fixture_stays(faulty):
    bench = faulty("P1", params={"dx": "1 mm", "dy": "0 mm", "speed": "25 mm/s"})
    before = bench.bench.truth.stage
    bench.run(60)
    assert bench.bench.truth.stage == pytest.approx(before, abs=1e-5)
    bench.output(1)
    bench.run(10)
    assert bench.bench.truth.part.name == "FFC1", "the part waits where it waited"
    assert bench.bench.truth.part.tip[0] == pytest.approx(before[0] - 1e-3, abs=1e-4)


@pytest.mark.parametrize("kind", ["P2", "P3", "P4"])
def test_a_plant_that_has_no_place_for_a_fault_is_named(faulty, kind):
    with pytest.raises(FaultError, match=rf"faults\[0\]: {kind} .*plant 'wall' has no place"):
        faulty(kind)


small, stages = st.floats(-0.02, 0.02), st.floats(-0.3, 0.3)


@given(st.builds(Shift, small, small, small), st.tuples(stages, stages, stages, stages))
def test_out_of_a_moved_frame_and_in_again_is_where_one_was(shift, stage):
    assert shift.inwards(shift.outwards(stage)) == pytest.approx(stage, abs=1e-12)
