"""Search policies by name, the privileged one included."""

from controller.action import Action, Observation, Policy
from controller.settings import Plan
from hil.app.cell import RunningCell
from hil.cell.plant.interface import PlantStep
from hil.cell.streams import stream
from learner.scripted import RandomPolicy, pose_script, spiral_script


class Oracle:
    """Reads the tip's true pose from the cell and steps along its largest error.

    The upper bound for every policy of this step size; it can only run where the truth is at hand.
    """

    def __init__(self, cell: RunningCell, sizes: tuple[float, float, float]) -> None:
        """Raises CellError where the truth is not at hand."""
        cell.truth()
        self._cell, self._sizes = cell, sizes

    def choose(self, _observation: Observation) -> Action:
        truth: PlantStep = self._cell.truth()
        error = (truth.part.tip[0], truth.part.tip[1], truth.part.theta)
        steps = [e / size for e, size in zip(error, self._sizes, strict=True)]
        axis = max(range(3), key=lambda i: abs(steps[i]))
        return Action(2 * axis + (steps[axis] > 0))


def policy(name: str, plan: Plan, seed: int, cell: RunningCell) -> Policy:
    """`pose`, `spiral`, `random` or `oracle`."""
    search = plan.search
    if name == "oracle":
        return Oracle(cell, (search.step, search.step, search.step_rotation))
    if name == "random":
        return RandomPolicy(stream(seed, "policy"))
    if name == "spiral":
        return spiral_script(search)
    return pose_script(search, plan.start.y)
