"""The FMEA file, what is owed by it, and the figures of a fault."""

from pathlib import Path

import numpy as np
import pytest

from hil.cell.errors import FaultError
from hil.cell.faults.catalogue import CATALOGUE
from hil.cell.faults.log import FaultEvent, Stage
from hil.cell.faults.schedule import Fault
from hil.trial.figures import figures
from hil.trial.fmea import load, parse
from hil.trial.owed import Owed
from hil.trial.signals import NAMES
from hil.trial.trace import Trace

ROOT = Path(__file__).parents[2]
ROW = """effect: e
detection: d
reaction: stop
budget_ms: 100
requirement: SR
test: t"""


def test_every_fault_of_the_catalogue_has_an_entry_in_its_order():
    assert list(load()) == [row.id for row in CATALOGUE]


def test_every_test_that_an_entry_names_is_there():
    for id, entry in load().items():
        path, _, name = entry.test.partition("::")
        assert f"def {name}(" in (ROOT / path).read_text(), id


def test_an_entry_that_is_missing_is_named():
    with pytest.raises(FaultError, match="no entry for T2"):
        parse("faults: {T1: {" + ROW.replace("\n", ", ") + "}}", "f.yaml")


def test_a_condition_on_a_parameter_that_the_fault_lacks_is_named():
    with pytest.raises(FaultError, match=r"R1.when.share"):
        parse("faults: {R1: {" + ROW.replace("\n", ", ") + ", when: {share: [1, 1]}}}", "f.yaml")


def test_a_stop_is_owed_for_the_parameters_that_the_file_says():
    loss = load()["C1"]
    assert loss.stops(Fault("C1", {"share": 1.0}))
    assert not loss.stops(Fault("C1", {"share": 0.4}))
    assert load()["C6"].stops(Fault("C6", {"state": "passive"}))
    assert not load()["C6"].stops(Fault("C6", {"state": "warning"}))


def owed(kind, *events, running=True):
    log = list(events)
    return Owed(((0, Fault(kind)),), load(), lambda: log)(running)


def event(stage, kind, t=0):
    return FaultEvent(t, 0, kind, stage)


def test_nothing_is_owed_before_a_fault_has_an_effect():
    assert owed("T3", event(Stage.ARMED, "T3")) == (0, False)


def test_a_lasting_fault_is_owed_a_stop_while_it_lasts():
    begun = (event(Stage.ARMED, "T3"), event(Stage.ACTIVE, "T3"))
    assert owed("T3", *begun) == (1, True)
    assert owed("T3", *begun, event(Stage.CLEARED, "T3")) == (0, False)


def test_a_fault_of_one_moment_is_owed_a_stop_for_good():
    assert owed("R1", event(Stage.ACTIVE, "R1"), event(Stage.CLEARED, "R1")) == (1, True)


def test_a_fault_that_may_be_ridden_out_owes_none():
    assert owed("T7", event(Stage.ACTIVE, "T7")) == (1, False)


def test_the_figures_count_from_the_faults_first_effect():
    columns = {name: np.zeros(100) for name in NAMES}
    columns["running"][:] = 1.0
    columns["t"] = np.arange(1, 101) * 8e-3
    columns["speed"][:60] = 0.1
    columns["stopping"][50:] = 1.0
    columns["force"][45:48] = 1.5
    trace = Trace(columns, ("search",) * 100)
    (found,) = figures(trace, [event(Stage.ACTIVE, "C1", 320_000_000)], 392_000_000)
    assert found.detection == pytest.approx(0.072)
    assert found.reaction == pytest.approx(0.088)
    assert found.stop == pytest.approx(0.168)
    assert found.exposure == 1.5
    assert found.over == pytest.approx(0.024)
    assert found.phase == "search"


def test_an_arm_that_moves_to_the_end_has_no_stop():
    columns = {name: np.zeros(10) for name in NAMES}
    columns["t"] = np.arange(1, 11) * 8e-3
    columns["speed"][:] = 0.1
    columns["stopping"][5:] = 1.0
    (found,) = figures(Trace(columns, ("x",) * 10), [event(Stage.ACTIVE, "C1")], None)
    assert found.stop is None


def test_a_fault_of_one_moment_that_was_over_before_the_job_began_is_owed_no_stop():
    over = event(Stage.ACTIVE, "C7"), event(Stage.CLEARED, "C7")
    assert owed("C7", *over, running=False) == (0, False)
    assert owed("C7", *over[:1], running=False) == (1, True)
