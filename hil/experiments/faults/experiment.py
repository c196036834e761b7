"""The campaigns of single faults."""

from typing import Final, cast

from hil.campaign.plan import Plan
from hil.campaign.run import Json, Run
from hil.cell.faults.schedule import Fault
from hil.cell.rig import parse
from hil.cell.streams import stream
from hil.experiments import warm_up
from hil.experiments.faults import draw
from hil.experiments.faults.run import one

LIMIT: Final = 300.0
"""Wall seconds of a run; one takes 3 to 15 on an idle core."""
FUNCTION: Final = f"{one.__module__}:{one.__name__}"


def random_plan(rig: str, runs: int, seed: int) -> Plan:
    """So many runs, each of one random fault and its own seed; RigError for a bad rig."""
    parse(rig)
    return _plan(
        [
            _run(rig, number, draw.drawn(stream(number, "experiment.faults"))[0])
            for number in range(seed, seed + runs)
        ]
    )


def each_plan(rig: str, seed: int) -> Plan:
    """Every fault in every phase where it makes sense, with its defaults."""
    parse(rig)
    return _plan([_run(rig, seed, fault) for fault, _ in draw.each()])


def _run(rig: str, seed: int, fault: Fault) -> Run:
    return Run(FUNCTION, rig, seed, {"fault": cast("Json", fault.written())})


def _plan(runs: list[Run]) -> Plan:
    unique = {run.key: run for run in runs}  # a fault of power-up has one phase only
    return Plan(FUNCTION, tuple(unique.values()), LIMIT, f"{warm_up.__name__}:cell")
