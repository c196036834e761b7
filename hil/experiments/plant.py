"""The plant against its closed forms: the table of `hil experiment plant`.

Straight on the physics, without wire, sensor errors or arm; the noise of a real cell comes later.
"""

from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from hashlib import sha256
from math import radians, sin
from multiprocessing import get_context
from time import process_time
from typing import NamedTuple

import numpy as np

from hil.cell.plant import beam
from hil.cell.plant.analytic import AnalyticPlant
from hil.cell.plant.ffc import FfcPlant
from hil.cell.plant.interface import Array
from hil.cell.rig import Rig
from hil.experiments.press import PERIOD, NewPlant, Press, with_values
from hil.experiments.row import Row, at_least, at_most, within

ASIDE = 1.5e-3
"""A place on the face well beside the slot, m in y."""
TRIALS = 20
"""Random drops of the basin's row."""
BULK = 0.25
"""N that a settled side force may depend on the step at 1 ms, which is meant for bulk runs."""


class Drop(NamedTuple):
    """Where a cable is let down: x, y, m, and theta, rad."""

    x: float
    y: float
    theta: float


def run(rig: Rig, seed: int) -> list[Row]:
    """Every row, well under a minute; raises PlantError where physics breaks."""
    rng = np.random.default_rng(seed)
    return [
        *_contact(rig),
        _drop_in_force(rig),
        *(_friction(rig, mu) for mu in (0.1, 0.2, 0.3, 0.4)),
        *(_buckling(rig, length) for length in (20e-3, 25e-3)),
        *_basin(rig, rng),
        *_outside(rig),
        _replay(rig, seed),
        *_step_size(rig),
        _speed(rig),
    ]


def _contact(rig: Rig) -> list[Row]:
    """Touch the face and hold: statics, overshoot, penetration, creep and the noise floor."""
    trial = Press(FfcPlant, rig, y=ASIDE)
    forces = [-float(trial.press()[2]) for _ in range(200)]
    depth = -trial.last.part.tip[2]
    still = np.array([trial.move()[2] for _ in range(125)])  # one second
    wanted = rig.task.contact_force
    return [
        within("T2", "static press, N", forces[-1], wanted, 0.01),
        at_most("T2", "overshoot at contact", 100 * (max(forces) / wanted - 1), 5.0, "%"),
        at_most("T3", "penetration into the face", depth * 1e6, 0.5, "um"),
        _creep(rig),
        at_most("T9", "force noise of the physics", float(still[50:].std()), 1e-6, "N"),
    ]


def _creep(rig: Rig) -> Row:
    """Slide of the tip in one second under half of the side force that would move it."""
    trial = Press(FfcPlant, rig, y=ASIDE)
    for _ in range(100):
        trial.press()
    limit = rig.connector.friction * rig.task.contact_force
    while abs(trial.wrench[1]) < limit / 2:
        trial.press(dy=1e-5)
    for _ in range(60):
        trial.press()
    before = trial.last.part.tip[1]
    for _ in range(125):
        trial.press()
    creep = abs(trial.last.part.tip[1] - before) * 1e6
    return at_most("T3", "creep in y at half the friction cone", creep, 0.5, "um/s")


def _drop_in_force(rig: Rig) -> Row:
    """Drag the pressed cable over the slot: finding it shows as a fall of the force."""
    trial = Press(FfcPlant, rig, y=ASIDE)
    for _ in range(100):
        trial.press()
    while trial.last.part.depth < 0.3e-3:
        trial.press(dy=-1e-5)
        if trial.last.stage[1] < -4 * ASIDE:
            return Row("T2", "fall of force at the slot", "slot missed", ">= 60 %", passed=False)
    least = min(-float(trial.press()[2]) for _ in range(5))
    fall = 100 * (1 - least / rig.task.contact_force)
    return at_least("T2", "fall of force within 40 ms of the slot", fall, 60.0, "%")


def _friction(rig: Rig, mu: float) -> Row:
    trial = Press(FfcPlant, with_values(rig, "connector", friction=mu), y=-6e-3)
    for _ in range(100):
        trial.press()
    plateau = max(abs(trial.press(dy=1e-5)[1]) / trial.force for _ in range(250))
    return within("T3", f"friction plateau fy / fz at mu = {mu}", plateau, mu, 0.03)


def _buckling(rig: Rig, length: float) -> Row:
    """Push a long cable down beside the slot, bent a little sideways first."""
    long = with_values(rig, "cable", free_length=length)
    trial = Press(FfcPlant, long, y=ASIDE)
    for _ in range(50):
        trial.move(dy=1e-5, dz=-1e-5)
    forces = [-float(trial.move(dz=-1e-5)[2]) for _ in range(150)]
    what = f"buckled force at L = {length * 1e3:.0f} mm, N"
    return within("T4", what, float(np.mean(forces[-30:])), beam.euler_load(long.cable), 0.10)


def _basin(rig: Rig, rng: np.random.Generator) -> list[Row]:
    """Random drops inside the sufficient rule: each must go in, in both plants."""
    drops = [_inside(rig, rng) for _ in range(TRIALS)]
    both: dict[str, NewPlant] = {"MuJoCo": FfcPlant, "analytic": AnalyticPlant}
    return [
        at_least("T5", f"of {TRIALS} drops in the basin, gone to the goal: {name}",
                 100 * float(np.mean([_goes_in(plant, rig, drop) for drop in drops])), bound, "%")
        for (name, plant), bound in zip(both.items(), (100.0, 95.0), strict=True)
    ]  # fmt: skip


def _inside(rig: Rig, rng: np.random.Generator) -> Drop:
    """A drop with |x| < c + 0.03 mm and |y| + w/2 |sin theta| < c + 0.035 mm, c the chamfer."""
    x_bound = rig.connector.chamfer + 0.03e-3
    y_bound = rig.connector.chamfer + 0.035e-3
    while True:
        x, y = rng.uniform(-x_bound, x_bound), rng.uniform(-y_bound, y_bound)
        theta = rng.uniform(-radians(2), radians(2))
        if abs(y) + rig.cable.width / 2 * abs(sin(theta)) < y_bound:
            return Drop(x, y, theta)


def _outside(rig: Rig) -> list[Row]:
    """Drops beyond the lead-in, on each axis: none may go in."""
    beyond = rig.connector.chamfer + 0.06e-3
    drops = [Drop(beyond, 0, 0), Drop(0, beyond, 0), Drop(0, 0, radians(3))]
    drops += [Drop(-d.x, -d.y, -d.theta) for d in drops]
    entered = sum(_goes_in(FfcPlant, rig, drop) for drop in drops)
    return [at_most("T5", f"of {len(drops)} drops beyond the lead-in, gone in", entered, 0, "")]


def _goes_in(plant: NewPlant, rig: Rig, drop: Drop) -> bool:
    """Whether four seconds of pressing, the stage held sideways, bring it to the goal depth."""
    trial = Press(plant, rig, *drop)
    for _ in range(500):
        trial.press()
        if trial.last.part.depth >= rig.task.goal_depth:
            return True
    return False


def _replay(rig: Rig, seed: int) -> Row:
    """The same seed in two fresh processes and in this one."""
    with ProcessPoolExecutor(2, get_context("spawn")) as pool:
        others = list(pool.map(digest, [rig, rig], [seed, seed]))
    same = set(others) == {digest(rig, seed)}
    said = "equal" if same else "different"
    return Row("T7", "SHA-256 of one run in three processes", said, "equal", same)


def digest(rig: Rig, seed: int) -> str:
    """SHA-256 over the wrenches of a random walk on the face."""
    rng = np.random.default_rng(seed)
    trial = Press(FfcPlant, rig, y=0.6e-3)
    hashed = sha256()
    for _ in range(150):
        trial.press(*rng.uniform(-2e-5, 2e-5, 2))
        hashed.update(trial.last.wrenches.tobytes())
    return hashed.hexdigest()


def _step_size(rig: Rig) -> list[Row]:
    """Settled side forces against a finer physics step, from several places on the face.

    Where stick-slip comes to rest depends on the step, so one path proves little.
    """
    fine = _settled(with_values(rig, "physics", step=0.1e-3))
    return [
        at_most("T8", f"settled fy, {step * 1e3:g} ms against 0.1 ms: worst of {fine.size}, "
                f"median {np.median(gap):.3f}", float(gap.max()), bound, "N")
        for step, bound in ((0.25e-3, 0.1), (0.5e-3, 0.1), (1e-3, BULK))
        for gap in [np.abs(_settled(with_values(rig, "physics", step=step)) - fine)]
    ]  # fmt: skip


def _settled(rig: Rig) -> Array:
    """Side force after each of eight 0.3 mm steps, from each of four places.  # (32,)."""
    return np.array([f for y in (1.0e-3, ASIDE, 2.2e-3, -5e-3) for f in _stepwise(rig, y)])


def _stepwise(rig: Rig, y: float) -> Iterator[float]:
    trial = Press(FfcPlant, rig, y=y)
    for _ in range(100):
        trial.press()
    for _ in range(8):
        for i in range(30):
            trial.press(dy=5e-5 if i < 6 else 0.0)
        yield float(trial.wrench[1])


def _speed(rig: Rig) -> Row:
    """Simulated per processor second of one core; shown, not judged: it is the machine's.

    Sliding on the face; the terminals' millisecond calls inside the slot cost more.
    """
    trial = Press(FfcPlant, rig, y=ASIDE)
    begin = process_time()
    for _ in range(300):
        trial.press(dy=2e-6)
    factor = 300 * PERIOD * 1e-9 / (process_time() - begin)
    return Row("T1", "times real time on one core", f"{factor:.1f}", "(not judged)", passed=True)
