"""A campaign: what the ledger lacks is computed, and all of it comes back in the plan's order."""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from importlib.util import find_spec

from hil.campaign.errors import CampaignError
from hil.campaign.ledger import Ledger
from hil.campaign.plan import Plan
from hil.campaign.pool import LocalPool, Pool
from hil.campaign.run import Outcome, Run


@dataclass(frozen=True, slots=True)
class Workers:
    """Where runs are performed. jobs: at once on this machine. scheduler: dask's, or ""."""

    jobs: int = 1
    scheduler: str = ""


Watch = Callable[[Run, Outcome], None]
"""Told of each run as it ends, those that the ledger held first."""


def carry_out(
    plan: Plan,
    ledger: Ledger,
    workers: Workers,
    code: str,
    watch: Watch = lambda run, outcome: None,
) -> list[Outcome]:
    """Outcomes of the plan's runs, in its order; the same for any workers. code: who computes.

    Each is in the ledger before the next is awaited, so an interrupted campaign goes on there.
    """
    known = {run.key: outcome for run in plan.runs if (outcome := ledger.find(run, code))}
    for run in plan.runs:
        if run.key in known:
            watch(run, known[run.key])
    missing = [run for run in plan.runs if run.key not in known]
    if missing:
        with _pool(plan, workers, len(missing), code) as pool:
            for run, outcome in pool.outcomes(missing):
                ledger.put(run, code, outcome)
                known[run.key] = outcome
                watch(run, outcome)
    return [known[run.key] for run in plan.runs]


def again(run: Run, limit: float) -> Outcome:
    """One run by itself, in a process of its own; no ledger learns of it."""
    plan = Plan(run.function, (run,), limit)
    with LocalPool(plan.work, 1) as pool:
        ((_, outcome),) = pool.outcomes(plan.runs)
    return outcome


def _pool(plan: Plan, workers: Workers, runs: int, code: str) -> AbstractContextManager[Pool]:
    jobs = min(workers.jobs, runs)
    if workers.scheduler or (jobs > 1 and find_spec("distributed")):
        return _dask(plan, workers.scheduler, jobs, code)
    return LocalPool(plan.work, jobs)


@contextmanager
def _dask(plan: Plan, scheduler: str, jobs: int, code: str) -> Iterator[Pool]:
    try:
        from hil.campaign import cluster  # noqa: PLC0415  an extra
    except ModuleNotFoundError:
        raise CampaignError(
            "a scheduler needs dask: pip install 'hil-testbed[campaign]', or leave it out"
        ) from None
    with cluster.connected(scheduler, jobs) as client:
        yield cluster.DaskPool(client, plan.work, code if scheduler else "")
