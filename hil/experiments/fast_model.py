"""The fast world of the cable task held against the contact plant, and its speed.

A trial: press at a random pose near the slot, then random steps, the same ones for both. Both say
what that came to. One step is hardly ever a danger; of a dozen, a few in a hundred are.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from time import process_time, thread_time

import numpy as np

from controller.action import Action, Observation
from controller.outcome import Kind
from hil.campaign.plan import Plan, grid
from hil.campaign.run import Outcome, Report, Run
from hil.cell.rig import Rig, parse
from hil.cell.streams import stream
from hil.experiments.ffc.direct import DirectCell, Offset
from learner.build import maker
from learner.interface import Learner, Transition
from learner.worlds.evaluate import Protocol, evaluate
from learner.worlds.named import model
from learner.worlds.slot import SlotWorld

CLASSES = ("face", "caught", "inserted", "danger")
NEAR = (4.0, 2.0, 3.0)
"""Steps off the slot, along x, y, theta, within which a trial begins: further off all is face."""
CAUGHT = 0.2e-3
"""m below the face."""
FACE = -0.25e-3
"""z of the gripper when a part is pressed on the face, m (within 0.03 mm, 98 % of 3,000 steps)."""
TRIALS = 25
"""Of one run of the campaign."""
LIMIT = 600.0


@dataclass(frozen=True, slots=True)
class Confusion:
    """counts: trials by (plant, world). agreement: share on which both agree."""

    counts: dict[str, dict[str, int]]
    trials: int
    agreement: float


class Given:
    """A policy of given steps, as many as will be asked for."""

    def __init__(self, actions: Sequence[Action]) -> None:
        self._actions = iter(actions)

    def choose(self, _observation: Observation) -> Action:
        return next(self._actions)


def plan(rig: str, poses: int, steps: int, seed: int) -> Plan:
    """So many poses, in runs of 25, each with so many steps."""
    runs = range(seed, seed - (-poses // TRIALS))
    return grid(f"{__name__}:one", rig, runs, variants=[{"steps": steps}], limit=LIMIT)


def one(run: Run) -> Report:
    """Trials of one seed: what plant and world made of each."""
    rig = parse(run.rig)
    task = rig.task.model_copy(update={"max_steps": int(str(run.variant["steps"]))})
    rig = rig.model_copy(update={"task": task})
    rng = stream(run.seed, "poses")
    pairs = [list(_trial(rig, rng)) for _ in range(TRIALS)]
    return Report({"pairs": pairs})


def _trial(rig: Rig, rng: np.random.Generator) -> tuple[str, str]:
    off = (rng.uniform(-1.0, 1.0, 3) * NEAR).tolist()
    actions = [Action(int(a)) for a in rng.integers(len(Action), size=rig.task.max_steps)]
    return _on_plant(rig, off, actions, rng), _in_world(off, actions, rng)


def _on_plant(
    rig: Rig, off: Sequence[float], actions: Sequence[Action], rng: np.random.Generator
) -> str:
    sizes = (rig.task.step, rig.task.step, rig.task.step_rotation)
    x, y, turn = (-o * size for o, size in zip(off, sizes, strict=True))
    slot: Offset = (x, y, turn)
    cell = DirectCell(rig, slot, (0.0, 0.0, 0.0), rng)
    kind, _, last = cell.attempt(Given(actions))
    return _class(kind, FACE - last.z)


def _in_world(off: Sequence[float], actions: Sequence[Action], rng: np.random.Generator) -> str:
    world = SlotWorld(model("ffc"))
    world.reset(rng)
    world.place(slot=(-off[0], -off[1], -off[2]))
    world.begin()
    for action in actions:
        met = world.step(action)
        if met.ending is not None:
            return _class(met.ending, -met.observation.z)
    return _class(Kind.LIMIT, -met.observation.z)


def _class(kind: Kind, depth: float) -> str:
    if kind in {Kind.INSERTED, Kind.DANGER}:
        return str(kind.value)
    return "caught" if depth > CAUGHT else "face"


def confusion(outcomes: Sequence[Outcome]) -> Confusion:
    """All trials of a campaign; broken runs count in nothing."""
    pairs = Counter(
        (str(plant), str(world)) for outcome in outcomes for plant, world in _pairs(outcome)
    )
    total = sum(pairs.values())
    counts = {a: {b: pairs[a, b] for b in CLASSES} for a in CLASSES}
    same = sum(pairs[a, b] for a, b in product(CLASSES, CLASSES) if a == b)
    return Confusion(counts, total, same / total if total else 0.0)


def _pairs(outcome: Outcome) -> list[tuple[str, str]]:
    found = outcome.figures.get("pairs", [])
    return [(str(a), str(b)) for a, b in found] if isinstance(found, list) else []


def episodes_a_minute(learner: str, seconds: float = 5.0) -> float:
    """Episodes that this machine trains on the fast world in a minute of one core, compiled."""
    make, world, done = maker(learner), SlotWorld(model("ffc")), 0
    _train(make(world.grid, world.max_steps, stream(0, "learner")), world, 0)
    begin = process_time()
    seed = 0
    while process_time() - begin < seconds:
        seed += 1
        done += _train(make(world.grid, world.max_steps, stream(seed, "learner")), world, seed)
    return 60.0 * done / (process_time() - begin)


def replanning(steps: int = 2000) -> tuple[float, float]:
    """p50 and p99 of what the belief learner takes to learn from a step and plan anew, s of CPU."""
    world = SlotWorld(model("ffc"))
    spent: list[float] = []
    learner = maker("belief")(world.grid, world.max_steps, stream(0, "learner"))
    timed = _Timed(learner, spent)
    seed = 0
    while len(spent) < steps:
        seed += 1
        _train(timed, world, seed)
    p50, p99 = np.quantile(spent, (0.5, 0.99))
    return float(p50), float(p99)


class _Timed:
    """A learner whose every `observe` is timed."""

    def __init__(self, learner: Learner, spent: list[float]) -> None:
        self._learner, self._spent = learner, spent
        self.begin, self.act, self.grip_changed = learner.begin, learner.act, learner.grip_changed
        self.save, self.load = learner.save, learner.load

    def observe(self, transition: Transition) -> None:
        begin = thread_time()
        self._learner.observe(transition)
        self._spent.append(thread_time() - begin)


def _train(learner: Learner, world: SlotWorld, seed: int) -> int:
    return sum(1 for _ in evaluate(learner, world, Protocol(), stream(seed, "world")))


def as_text(found: Confusion, speeds: dict[str, float], planning: tuple[float, float]) -> str:
    """A line a class of the plant's, then speeds."""
    head = f"{'plant / fast model':20s}" + "".join(f"{name:>10s}" for name in CLASSES)
    lines = [head]
    lines += [
        f"{name:20s}" + "".join(f"{found.counts[name][other]:10d}" for other in CLASSES)
        for name in CLASSES
    ]
    lines.append(f"{found.trials} poses, the same outcome on {100 * found.agreement:.1f} %")
    lines += [
        f"{name}: {speed:,.0f} episodes in a minute of one core" for name, speed in speeds.items()
    ]
    p50, p99 = (1e6 * seconds for seconds in planning)
    lines.append(f"belief: learns from a step and plans anew in {p50:.0f} us, p99 {p99:.0f} us")
    return "\n".join(lines) + "\n"
