"""What a campaign of faults draws, and what it calls late."""

import numpy as np
import pytest

from hil.cell.faults.catalogue import CATALOGUE
from hil.cell.faults.log import FaultEvent, Stage
from hil.experiments.faults import draw
from hil.experiments.faults.run import late
from hil.trial.figures import Figures

MS = 1_000_000
RUNS = [draw.drawn(np.random.default_rng(seed))[0] for seed in range(600)]


def stood(kind, stop):
    return Figures(kind, 0, 4.0, "approach", 0.1, 0.1, stop, 0.1, 0.0)


def lasted(kind, ms):
    return [
        FaultEvent(4000 * MS, 0, kind, Stage.ACTIVE),
        FaultEvent((4000 + ms) * MS, 0, kind, Stage.CLEARED),
    ]


def test_a_fault_that_outlasts_its_budget_owes_a_stop_within_it():
    assert late([stood("T4", 0.6)], lasted("T4", 700), 500.0).startswith("T4: standstill after 600")
    assert not late([stood("T4", 0.4)], lasted("T4", 700), 500.0)
    assert late([stood("T4", 0.6)], [], 500.0)


def test_a_fault_that_is_over_before_its_watchdog_bites_may_be_ridden_out():
    """A campaign's run had 22 periods of a half-open link, and was called late for not stopping."""
    assert not late([stood("T4", 12.6)], lasted("T4", 176), 500.0)


def test_a_fault_of_one_moment_owes_a_stop_although_it_is_over_at_once():
    assert late([stood("R1", 0.6)], lasted("R1", 0), 500.0)


def test_a_campaign_draws_every_fault_that_an_assembly_has_a_place_for():
    assert {fault.kind for fault in RUNS} == {row.id for row in CATALOGUE}


@pytest.mark.parametrize("kind", draw.MET)
def test_what_acts_only_where_the_job_meets_it_lasts_to_the_end(kind):
    assert {fault.duration for fault in RUNS if fault.kind == kind} == {None}
