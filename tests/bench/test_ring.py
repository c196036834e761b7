import threading

import numpy as np
import pytest

from hil.bench.case import chosen
from hil.bench.compare import Compared, compare
from hil.bench.ring import ring
from hil.cell.errors import RigError
from hil.cell.plant.ffc import FfcPlant
from hil.experiments.press import Press, over_connector
from hil_fixtures.testbed import shipped

RIG = shipped("ffc_ur5")
ASIDE = 1.2e-3
PERIOD = 8_000_000
QUANTUM = np.array([0.015] * 3 + [0.312e-3] * 3)


def test_what_comes_round_the_ring_is_what_the_plant_felt_to_a_count():
    placed = over_connector(RIG, ASIDE, ASIDE)
    with ring(placed, np.random.default_rng(0)) as bare:
        wired = Press(lambda _rig, _rng: bare, RIG, ASIDE, ASIDE)
        direct = Press(FfcPlant, RIG, ASIDE, ASIDE)
        for moment in range(30):
            wired.move(dz=-0.03e-3)
            direct.move(dz=-0.03e-3)
            off = np.abs(wired.last.wrenches - direct.last.wrenches)
            assert (off <= 0.5 * QUANTUM + 1e-12).all(), moment
            assert wired.last.stage == direct.last.stage
    assert direct.force > 1.0, "the cable was to be pressed on the face"


def test_a_ring_leaves_no_thread_behind():
    with ring(over_connector(RIG), np.random.default_rng(0)):
        assert any(thread.name == "ring" for thread in threading.enumerate())
    assert not any(thread.name == "ring" for thread in threading.enumerate())


def test_loop_and_ring_are_measured_in_pairs():
    (case,) = chosen(("free_125hz_1ms",))
    found = compare(RIG, b"name: x\n", case, 0.1, 2)
    assert len(found.loop) == len(found.ring) == 2
    assert min(found.loop + found.ring) > 0


def test_a_share_of_the_rings_speed_is_taken_pair_by_pair():
    (case,) = chosen(("free_125hz_1ms",))
    assert Compared(case, (4.0, 9.0, 3.0), (8.0, 9.0, 4.0)).figures()["of_ring"] == 0.75


def test_a_case_by_the_wall_clock_has_no_ring():
    (case,) = chosen(("wall_125hz",))
    with pytest.raises(RigError, match="wall_125hz runs by the wall clock"):
        compare(RIG, b"name: x\n", case, 0.1, 1)
