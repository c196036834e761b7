"""The figures of a fault, from traces in which it is known what happened when."""

import numpy as np
import pytest

from hil.cell.faults.log import FaultEvent, Stage
from hil.trial.figures import figures
from hil.trial.signals import NAMES
from hil.trial.trace import Trace

PERIOD = 8e-3
COUNT = 250


def found(at=100, noticed=None, **changes):
    """Figures of a fault at the end of a period of a 2 s trace; signals as (begin, end, value)."""
    columns = {name: np.zeros(COUNT) for name in NAMES}
    columns["t"] = np.arange(1, COUNT + 1) * PERIOD
    columns["running"][:] = 1.0
    for name, spans in changes.items():
        for begin, end, value in spans:
            columns[name][begin:end] = value
    event = FaultEvent(round(at * PERIOD * 1e9), 0, "C1", Stage.ACTIVE)
    (figure,) = figures(Trace(columns, ("search",) * COUNT), [event], noticed)
    return figure


MOVES = [(0, 110, 0.1)]
STOPS = [(105, COUNT, 1.0)]


def test_a_stop_is_measured_from_the_fault_to_the_last_motion():
    figure = found(speed=MOVES, stopping=STOPS)
    assert figure.reaction == pytest.approx(6 * PERIOD)
    assert figure.stop == pytest.approx(11 * PERIOD)


def test_an_arm_that_still_moves_when_the_run_ends_has_no_stop():
    figure = found(speed=[(0, COUNT, 0.1)], stopping=STOPS)
    assert figure.reaction is not None
    assert figure.stop is None


def test_a_job_that_came_to_its_end_was_not_stopped_by_the_fault():
    figure = found(speed=MOVES, stopping=STOPS, running=[(104, COUNT, 0.0)])
    assert (figure.detection, figure.reaction, figure.stop) == (None, None, None)


def test_an_arm_that_stood_anyway_stands_for_good_from_the_reaction_on():
    figure = found(stopping=STOPS)
    assert figure.stop == figure.reaction == pytest.approx(6 * PERIOD)


def test_a_fault_that_acts_after_the_last_period_shows_nothing():
    figure = found(at=COUNT + 1, speed=[(0, COUNT, 0.1)], stopping=STOPS, force=[(0, COUNT, 2.0)])
    assert (figure.detection, figure.reaction, figure.stop) == (None, None, None)
    assert (figure.exposure, figure.over) == (0.0, 0.0)


def test_a_trace_in_a_failing_assertion_does_not_bury_it():
    columns = {name: np.zeros(COUNT) for name in NAMES}
    assert repr(Trace(columns, ("search",) * COUNT)) == "Trace()"
