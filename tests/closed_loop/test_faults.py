"""Faults through the whole loop: felt at their place, seen by the near side, always the same."""

from dataclasses import replace

import pytest

from hil.app.run import Request, run
from hil.cell.errors import FaultError
from hil.cell.faults.log import Stage, idle
from hil.cell.faults.parse import schedule
from hil.recording.channel import Channel
from hil.recording.read import load

PICK_UP = {"event": "phase: pick up", "offset": "+5 cycles"}


def failing(rig, out, *kinds, **choices):
    faults = schedule([{"kind": kind, "trigger": PICK_UP} for kind in kinds])
    return run(Request(rig, b"rig", 1, "FFC1", out=out, faults=faults, **choices), lambda *_: None)


def test_a_run_with_faults_repeats_to_the_byte_wherever_the_cell_runs(rig, tmp_path):
    found = [
        failing(rig, tmp_path / layout, "T1", "S3", layout=layout)
        for layout in ("inline", "process")
    ]
    assert found[0].faults == found[1].faults
    assert found[0].digest == found[1].digest
    assert idle(found[0].faults) == ()
    assert "FlatSignalError" in found[0].outcome.reason


def test_what_became_of_a_fault_is_recorded(rig, tmp_path):
    result = failing(rig, tmp_path / "run", "R1")
    assert "ProtectiveStopError" in result.outcome.reason
    stages = [event.stage for event in result.faults]
    assert stages == [Stage.ARMED, Stage.ACTIVE, Stage.CLEARED]
    found = load(tmp_path / "run").messages
    texts = [message.payload for message in found if message.topic == Channel.EVENT.topic]
    assert any(b"R1 [0] active: protective stop" in text for text in texts)


def test_a_dead_direction_is_found_out_by_the_robots_own_watchdog(rig, tmp_path):
    result = failing(rig, tmp_path / "run", "T4")
    assert "commands fell silent" in result.outcome.reason


def test_a_full_disk_leaves_a_marked_gap_and_control_as_it_was(rig, tmp_path):
    def run_with(kind, at, name):
        trigger = {"at": at}
        faults = schedule([{"kind": kind, "trigger": trigger, "duration": "0.5 s"}])
        request = Request(rig, b"rig", 1, "FFC1", out=tmp_path / name, faults=faults)
        return run(request, lambda *_: None)

    full, sound = run_with("H4", "3 s", "full"), run_with("H4", "1000 s", "sound")
    assert idle(full.faults) == ()
    assert full.outcome == sound.outcome
    found = load(tmp_path / "full").messages
    texts = [message.payload for message in found if message.topic == Channel.EVENT.topic]
    assert any(b"gap: " in text for text in texts)


@pytest.mark.parametrize(
    ("kind", "complaint"),
    [("L3", "no parallel learner"), ("H4", "writes no recording")],
)
def test_a_run_without_a_faults_place_says_so_before_anything_moves(rig, kind, complaint):
    request = Request(rig, b"", 1, "FFC1", faults=schedule([kind]))
    with pytest.raises(FaultError, match=complaint):
        run(request, lambda *_: None)


def test_a_cell_read_over_tcp_has_no_bus_that_could_fail(rig):
    on_tcp = rig.model_copy(update={"sensor": rig.sensor.model_copy(update={"wire": "tcp"})})
    request = Request(rig, b"", 1, "FFC1", faults=schedule(["can.drop"]))
    with pytest.raises(FaultError, match="read over tcp"):
        run(replace(request, rig=on_tcp), lambda *_: None)
