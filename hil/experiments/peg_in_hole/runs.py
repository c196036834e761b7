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
from learner.neural.settings import Method
from learner.tabular.settings import Tabular
from learner.worlds.evaluate import Protocol, Result, evaluate
from learner.worlds.named import model
from learner.worlds.slot import SlotWorld

LIMIT = 3600.0
"""Wall seconds of one run; the longest, a net on the whole gridworld, takes about a minute alone on
a core, and many on a busy one."""
NEURAL = {method.value for method in Method}


def plan(world: str, contenders: tuple[Contender, ...], seeds: range, protocol: Protocol) -> Plan:
    """Every contender on every seed; UnknownWorldError for a name that is none."""
    model(world)
    function = f"{__name__}:one"
    variants = [
        {"world": world, **contender._asdict(), **asdict(protocol)} for contender in contenders
    ]
    runs = (Run(function, "", seed, variant) for variant in variants for seed in seeds)
    nets = any(contender.learner in NEURAL for contender in contenders)
    prepare = f"{__name__}:{'with_nets' if nets else 'rules'}"
    return Plan(function, tuple(runs), LIMIT, prepare)


def rules(run: Run) -> None:
    """Load what all runs share: the compiled rules."""
    made(Contender("wdql", 1), _world(run), GAMMA, stream(run.seed, "learner"))


def with_nets(run: Run) -> None:
    """And torch, which takes seconds."""
    rules(run)
    made(Contender("pg"), _world(run), GAMMA, stream(run.seed, "learner"))


def one(run: Run) -> Report:
    """Train once and list the episodes."""
    chosen = run.variant
    world, contender = _world(run), _contender(run)
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


def _world(run: Run) -> SlotWorld:
    return SlotWorld(model(str(run.variant["world"])))


def _contender(run: Run) -> Contender:
    chosen = (run.variant[name] for name in Contender._fields)
    return TypeAdapter(Contender).validate_python(tuple(chosen))


def _training(run: Run, outcome: Outcome) -> Training:
    label = _contender(run).label
    if not outcome.figures:
        return Training(label, run.seed, (), outcome.verdict.value)
    results = TypeAdapter(list[Result]).validate_python(outcome.figures["episodes"])
    # No robot runs here, so there is no time that an episode could have taken.
    episodes = (EpisodeResult(r.number, f"FFC{r.part}", r.kind, "", r.steps, nan) for r in results)
    return Training(label, run.seed, tuple(episodes))
