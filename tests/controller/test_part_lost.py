"""What the job does with empty hands, and with jaws that do not let go."""

import pytest

from controller.course import LOST, Course
from controller.cycle import Cycle
from controller.errors import PartLostError
from controller.phases.pick_up import put_down, release
from controller.place import Place
from controller.settings import Grip, Travel

HERE = Place(0.0, 0.0, 0.0, 0.0)


def cycle(t=0, state=None):
    return Cycle(t, state, None, (0.0,) * 6, HERE)


def driven(course, phase, states):
    """Run the phase over these states, then over the last one again; what it returned."""
    t, states = 0, list(states)
    try:
        next(phase)
        while True:
            t += 8_000_000
            phase.send(cycle(t, states.pop(0) if len(states) > 1 else states[0]))
    except StopIteration as end:
        return end.value


def dwelling(course, duration):
    yield from course.dwell(duration)


def test_a_part_that_is_gone_for_a_few_cycles_ends_the_job():
    course = Course(cycle(), 0.008)
    course.carry(lambda state: state)
    with pytest.raises(PartLostError, match="part lost"):
        driven(course, dwelling(course, 1.0), [True] * 5 + [False])


def test_a_grip_sensor_that_blinks_does_not():
    course = Course(cycle(), 0.008)
    course.carry(lambda state: state)
    blinking = ([False] * (LOST - 1) + [True]) * 20
    driven(course, dwelling(course, 0.3), blinking)


def test_nobody_minds_empty_jaws_when_there_is_nothing_to_carry():
    course = Course(cycle(), 0.008)
    course.carry(lambda state: state)
    course.carry(None)
    driven(course, dwelling(course, 0.1), [False])


class Jaws:
    def __init__(self):
        self.opened = False

    def open(self):
        self.opened = True

    def close(self):
        pass

    def holds(self, state):
        return state


def test_jaws_that_do_not_let_go_are_told_of():
    course, jaws = Course(cycle(), 0.008), Jaws()
    assert driven(course, release(course, jaws, Grip()), [True]) is False
    assert jaws.opened
    assert driven(course, release(course, jaws, Grip()), [False]) is True


def test_a_part_that_is_stuck_in_the_jaws_is_not_carried_off():
    course, jaws = Course(cycle(), 0.008), Jaws()
    part = Place(0.1, 0.0, 0.0, 0.0)
    assert driven(course, put_down(course, jaws, part, Grip(), Travel()), [True]) is False
    assert course.setpoint == part
