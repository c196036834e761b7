"""One run of the campaign: a trial, and its figures."""

from collections.abc import Iterable, Sequence
from dataclasses import asdict
from math import inf

from hil.campaign.run import Json, Report, Run
from hil.campaign.run import Verdict as Ended
from hil.cell.faults.catalogue import row
from hil.cell.faults.log import FaultEvent, Stage
from hil.cell.faults.parse import fault as parsed
from hil.cell.faults.row import Place, phase_of
from hil.cell.faults.schedule import Fault, Schedule
from hil.cell.rig import parse
from hil.trial.figures import Figures
from hil.trial.fmea import Entry, load
from hil.trial.trial import Trial, run_trial
from hil.trial.verdict import Verdict


def one(run: Run) -> Report:
    """Run the fault in the variant; passed when the run was safe and the fault had an effect."""
    rig = parse(run.rig).on_free_ports()
    chosen = parsed("fault", run.variant["fault"])
    policy = "wdql" if chosen.row.place is Place.AGENTS else "pose"
    trial = run_trial(rig, run.seed, Schedule((chosen,)), policy=policy)
    entry = load()[chosen.kind]
    owed = trial.faults if entry.stops(chosen) else ()
    over = late(owed, trial.events, entry.budget_ms) or lost(
        trial.faults, trial.events, entry, chosen
    )
    verdict = Ended.FAILED if over and trial.verdict is Verdict.PASSED else _ended(trial)
    return Report(_figures(trial, chosen.kind), verdict, over or trial.reason)


def _ended(trial: Trial) -> Ended:
    return Ended(trial.verdict.value)


def late(faults: Iterable[Figures], events: Sequence[FaultEvent], budget: float) -> str:
    """Which budget, ms, was passed; "" for none. A fault that was over before it owes no stop."""
    for found in faults:
        stop = 0.0 if found.stop is None else found.stop * 1e3
        if stop > budget and _lasted(found, events) * 1e3 > budget:
            return f"{found.kind}: standstill after {stop:.0f} ms, budget {budget:g} ms"
    return ""


def lost(
    faults: Iterable[Figures], events: Sequence[FaultEvent], entry: Entry, fault: Fault
) -> str:
    """From what the near side did not come back within its budget; "" for nothing.

    What is still in force, or never stopped the arm, need not be come back from.
    """
    budget = entry.recovery_ms
    for found in faults:
        cleared = any(e.index == found.index and e.stage is Stage.CLEARED for e in events)
        owed = budget and (cleared if entry.comes_back(fault) else found.recovery is not None)
        if owed and (found.recovery is None or found.recovery * 1e3 > budget):
            took = "never" if found.recovery is None else f"after {found.recovery * 1e3:.0f} ms"
            return f"{found.kind}: ready again {took}, budget {budget:g} ms"
    return ""


def _lasted(of: Figures, events: Iterable[FaultEvent]) -> float:
    """Bench seconds; inf for what is over only once somebody has set it right."""
    for event in events:
        if event.index == of.index and event.stage is Stage.CLEARED and row(event.kind).lasting:
            return event.t * 1e-9 - of.active
    return inf


def _figures(trial: Trial, kind: str) -> dict[str, Json]:
    found = trial.faults[0] if trial.faults else None
    return {
        "kind": kind,
        "active": found is not None,
        "phase": phase_of(found.phase).value if found else "",
        "figures": asdict(found) if found else {},
        "ending": trial.outcome.kind.value if trial.outcome else "",
        "violations": [str(violation) for violation in trial.violations],
        "worst": min(trial.worst, 1e9),
        "digest": trial.digest,
    }
