"""One run of the campaign: a trial, and its figures."""

from dataclasses import asdict

from hil.campaign.run import Json, Report, Run
from hil.campaign.run import Verdict as Ended
from hil.cell.faults.parse import fault
from hil.cell.faults.row import phase_of
from hil.cell.faults.schedule import Schedule
from hil.cell.rig import parse
from hil.trial.fmea import load
from hil.trial.trial import Trial, run_trial
from hil.trial.verdict import Verdict


def one(run: Run) -> Report:
    """Run the fault in the variant; passed when the run was safe and the fault had an effect."""
    rig = parse(run.rig).on_free_ports()
    chosen = fault("fault", run.variant["fault"])
    trial = run_trial(rig, run.seed, Schedule((chosen,)))
    late = _late(trial, load()[chosen.kind].budget_ms, owed=load()[chosen.kind].stops(chosen))
    verdict = Ended.FAILED if late and trial.verdict is Verdict.PASSED else _ended(trial)
    return Report(_figures(trial, chosen.kind), verdict, late or trial.reason)


def _ended(trial: Trial) -> Ended:
    return Ended(trial.verdict.value)


def _late(trial: Trial, budget: float, *, owed: bool) -> str:
    """Which budget was passed; "" for none."""
    for found in trial.faults if owed else ():
        if found.stop is not None and found.stop * 1e3 > budget:
            return f"{found.kind}: standstill after {found.stop * 1e3:.0f} ms, budget {budget:g} ms"
    return ""


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
