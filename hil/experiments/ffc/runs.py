"""The runs: one training of one learner on one seed's cell, over the wire in lockstep."""

from contextlib import ExitStack
from dataclasses import asdict, dataclass

from pydantic import TypeAdapter

from controller.outcome import Kind
from hil.app.inline import InlineCell
from hil.app.train import EpisodeResult, Schedule, connected
from hil.campaign.plan import Plan, grid
from hil.campaign.run import Json, Outcome, Report, Run, Verdict
from hil.cell.rig import Rig, parse
from hil.cell.streams import stream
from hil.experiments.ffc.sight import Sight, Watcher
from learner.build import maker
from learner.grid import Grid
from learner.surface import surface

LIMIT = 3600.0
"""Wall seconds of a training of 50 episodes; one takes about 60 on an idle core."""


@dataclass(frozen=True, slots=True)
class Training:
    """One run's episodes, in order; broken: the runner's verdict on a run that never came back.

    sight: forces of one episode and the final policy, for the figures.
    """

    learner: str
    seed: int
    episodes: tuple[EpisodeResult, ...]
    broken: str = ""
    sight: Sight | None = None


def box(rig: Rig) -> Grid:
    """The search box of a rig's task as a learner's states."""
    task = rig.task
    return Grid(task.search_cells, (task.step, task.step, task.step_rotation))


def plan(rig: str, learners: tuple[str, ...], seeds: range, schedule: Schedule) -> Plan:
    """Every learner on every seed; UnknownLearnerError for a name that is none."""
    for name in learners:
        maker(name)
    parts: list[Json] = [[name, count] for name, count in schedule.parts]
    return grid(
        f"{__name__}:one",
        rig,
        seeds,
        variants=[{"learner": name, "parts": parts} for name in learners],
        limit=LIMIT,
        prepare=f"{__name__}:prepare",
    )


def prepare(run: Run) -> None:
    """Load what all runs share once: MuJoCo, the drivers, the compiled rules."""
    rig = parse(run.rig).on_free_ports()
    maker("wdql")(box(rig), rig.task.max_steps, stream(run.seed, "learner"))
    with InlineCell(rig, run.seed, "lockstep", record=False):
        pass


def one(run: Run) -> Report:
    """Train once; failed when an episode of the verification did not insert."""
    rig = parse(run.rig).on_free_ports()
    schedule = TypeAdapter(Schedule).validate_python({"parts": run.variant["parts"]})
    make = maker(str(run.variant["learner"]))
    learner = make(box(rig), rig.task.max_steps, stream(run.seed, "learner"))
    with ExitStack() as stack:
        cell = stack.enter_context(InlineCell(rig, run.seed, "lockstep", record=False))
        watcher = Watcher()
        trainer = connected(rig, cell, stack, watcher.watch, None)
        episodes = []
        for result in trainer.run(learner, schedule, run.seed):
            watcher.ended(result)
            episodes.append(asdict(result))
    for episode in episodes:
        episode["kind"] = episode["kind"].value
    verified = all(
        episode["kind"] == Kind.INSERTED.value
        for episode in episodes
        if episode["part"] != schedule.parts[0][0]
    )
    sight = asdict(watcher.sight(surface(learner)))
    return Report(
        {"episodes": episodes, "sight": sight}, Verdict.PASSED if verified else Verdict.FAILED
    )


def trainings(plan: Plan, outcomes: list[Outcome]) -> list[Training]:
    """A training for each run of the plan."""
    return [_training(run, outcome) for run, outcome in zip(plan.runs, outcomes, strict=True)]


def _training(run: Run, outcome: Outcome) -> Training:
    name = str(run.variant["learner"])
    if not outcome.figures:
        return Training(name, run.seed, (), outcome.verdict.value)
    found = TypeAdapter(tuple[EpisodeResult, ...]).validate_python(outcome.figures["episodes"])
    sight = TypeAdapter(Sight).validate_python(outcome.figures["sight"])
    return Training(name, run.seed, found, sight=sight)
