"""What a campaign of faults draws, and what it calls late."""

import numpy as np
import pytest

from hil.campaign.ledger import Entry
from hil.campaign.run import Outcome, Run, Verdict
from hil.cell.faults.catalogue import CATALOGUE
from hil.cell.faults.log import FaultEvent, Stage
from hil.cell.faults.row import Phase
from hil.experiments.faults import draw
from hil.experiments.faults.coverage import as_markdown, as_text, coverage
from hil.experiments.faults.experiment import FUNCTION
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


def test_each_fault_is_tried_in_each_of_its_phases_once_the_arm_moves():
    tried = list(draw.each())
    assert {fault.kind for fault, _ in tried} == {row.id for row in CATALOGUE}
    begins = {(fault.kind, phase): str(fault.trigger.event) for fault, phase in tried}
    assert begins["C1", Phase.FREE] == "phase: pick up"
    assert begins["C1", Phase.INSERT] == "phase: insert"
    assert begins["S5", Phase.FREE] == "phase: free"


def test_a_random_fault_of_free_air_begins_once_the_arm_moves():
    """At the start, where the arm stands, most of them were over without an effect."""
    early = {
        fault.kind
        for fault in RUNS
        if fault.trigger.event is not None and fault.trigger.event.name == "free"
    }
    assert early <= {row.id for row in CATALOGUE if row.phases == (Phase.FREE,)}


def test_what_is_drawn_for_the_search_can_act_there():
    blocked = [fault for fault in RUNS if fault.kind == "P3" and fault.word("what") == "blocked"]
    assert {str(fault.trigger.event) for fault in blocked} == {"phase: insert"}


def ran(kind, phase, verdict=Verdict.PASSED, **figures):
    """A run of a ledger: where the fault was active, "" for nowhere."""
    found = {"active": bool(phase), "phase": phase, "figures": figures}
    run = Run(FUNCTION, "", 1, {"fault": {"kind": kind, "trigger": phase}})
    return Entry(run.key, "code", Outcome(verdict, "", found))


def test_coverage_counts_what_was_active_and_keeps_the_worst_figures():
    rows = coverage(
        [
            ran("C1", "contact", detection=0.01, reaction=0.02, stop=0.1, exposure=0.4, recovery=2),
            ran("C1", "search", detection=0.03, reaction=None, stop=None, exposure=0.2),
            ran("P3", "", Verdict.VACUOUS),
        ]
    )
    found = {row.id: row for row in rows}
    assert len(rows) == 52
    c1 = found["C1"]
    assert (c1.detection, c1.reaction, c1.stop, c1.exposure) == (0.03, 0.02, 0.1, 0.4)
    assert c1.active["contact"] == c1.active["search"] == 1
    assert c1.open == ("free", "approach", "insert", "retract")
    assert found["P3"].active == dict.fromkeys(Phase) | {"search": 0, "insert": 0}
    assert found["P3"].verdicts == {"vacuous": 1}
    page = as_markdown(rows, "hil experiment faults --each")
    figures = "30 ms | 20 ms | 100 ms | 0.40 | 2000 ms | 2 passed |"
    assert f"| C1 `can.drop` | stop | 0 | 0 | 1 | 1 | 0 | 0 | {figures}" in page.splitlines()
    assert found["T6"].open == ("free",)
    assert "3 runs (2 passed, 1 vacuous)" in page
    assert "P3 (search, insert)" in as_text(rows)
