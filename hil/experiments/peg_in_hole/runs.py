"""The runs: one learner through the paper's protocol on one world, its slot drawn from the seed."""

from dataclasses import asdict
from math import nan

from pydantic import TypeAdapter

from hil.app.train import EpisodeResult
from hil.campaign.plan import Plan
from hil.campaign.run import Outcome, Report, Run, Verdict
from hil.cell.streams import stream
from hil.experiments.ffc.runs import Training
from hil.experiments.peg_in_hole.contender import GAMMA, Contender, made, shared
from hil.experiments.peg_in_hole.shared import MAX_STEPS, train
from learner.tabular.settings import Tabular
from learner.worlds.evaluate import Protocol, Result, evaluate
from learner.worlds.named import model
from learner.worlds.slot import SlotWorld

LIMIT = 600.0
"""Wall seconds of one run; the longest, shared Q-tables of one robot, takes about ten."""


def plan(world: str, contenders: tuple[Contender, ...], seeds: range, protocol: Protocol) -> Plan:
    """Every contender on every seed; UnknownWorldError for a name that is none."""
    model(world)
    function = f"{__name__}:one"
    variants = [
        {"world": world, **contender._asdict(), **asdict(protocol)} for contender in contenders
    ]
    runs = (Run(function, "", seed, variant) for variant in variants for seed in seeds)
    return Plan(function, tuple(runs), LIMIT)


def one(run: Run) -> Report:
    """Train once and list the episodes."""
    chosen = run.variant
    world = SlotWorld(model(str(chosen["world"])))
    contender = TypeAdapter(Contender).validate_python((chosen["learner"], chosen["agents"]))
    protocol = TypeAdapter(Protocol).validate_python(
        {"training": chosen["training"], "verification": chosen["verification"]}
    )
    results = _results(world, contender, protocol, run)
    listed = [{**asdict(result), "kind": result.kind.value} for result in results]
    return Report({"episodes": listed}, Verdict.PASSED)


def _results(world: SlotWorld, contender: Contender, protocol: Protocol, run: Run) -> list[Result]:
    """The same seed is the same slot and grips for every contender."""
    gamma = GAMMA if run.variant["world"] == "G0" else Tabular().gamma
    dice, nature = stream(run.seed, "learner"), stream(run.seed, "world")
    if contender.learner in shared():
        world.reset(nature)
        rule = shared()[contender.learner]
        settings = Tabular(rule, gamma=gamma, max_steps=MAX_STEPS)
        return list(train(world, settings, contender.agents, protocol.training, dice))
    return list(evaluate(made(contender, world, gamma, dice), world, protocol, nature))


def trainings(plan: Plan, outcomes: list[Outcome]) -> list[Training]:
    """A training for each run of the plan."""
    return [_training(run, outcome) for run, outcome in zip(plan.runs, outcomes, strict=True)]


def _training(run: Run, outcome: Outcome) -> Training:
    chosen = run.variant
    label = TypeAdapter(Contender).validate_python((chosen["learner"], chosen["agents"])).label
    if not outcome.figures:
        return Training(label, run.seed, (), outcome.verdict.value)
    results = TypeAdapter(list[Result]).validate_python(outcome.figures["episodes"])
    # No robot runs here, so there is no time that an episode could have taken.
    episodes = (EpisodeResult(r.number, f"FFC{r.part}", r.kind, "", r.steps, nan) for r in results)
    return Training(label, run.seed, tuple(episodes))
