"""Silence of an RTDE input."""

import pytest

from hil.cell.arm.watchdog import Action, Watchdog

MS = 1_000_000


def test_a_silent_input_trips_after_its_period():
    dog = Watchdog()
    dog.watch("input_int_register_0", 2.0, "stop", 0)
    assert dog.tripped(500 * MS) is None
    assert dog.tripped(500 * MS + 1) == ("input_int_register_0", Action.STOP)


def test_a_heard_input_does_not_trip():
    dog = Watchdog()
    dog.watch("input_int_register_0", 10.0, "pause", 0)
    for t in range(0, 2000, 80):
        dog.heard([{"input_int_register_0": 1}], t * MS)
        assert dog.tripped(t * MS) is None


def test_another_input_does_not_calm_it():
    dog = Watchdog()
    dog.watch("input_int_register_0", 10.0, "pause", 0)
    dog.heard([{"input_int_register_1": 1}], 90 * MS)
    assert dog.tripped(101 * MS) is not None


def test_it_trips_once():
    dog = Watchdog()
    dog.watch("input_int_register_0", 10.0, "stop", 0)
    assert dog.tripped(101 * MS)
    assert dog.tripped(500 * MS) is None


@pytest.mark.parametrize(("frequency", "action"), [(0.0, "stop"), (-1.0, "stop"), (1.0, "explode")])
def test_a_senseless_watch_is_refused(frequency, action):
    with pytest.raises(ValueError, match=r"frequency|explode"):
        Watchdog().watch("input_int_register_0", frequency, action, 0)
