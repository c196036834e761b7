"""Eqs. 1, 2 and 4 of the paper: what an agent sees, what it may do, and what it is paid."""

from controller.action import Action, Observation, Policy
from controller.outcome import Kind

__all__ = ["Action", "Observation", "Policy", "reward"]


def reward(kind: Kind, step: int, max_steps: int) -> float:
    """Eq. 4 for an episode that ended so after `step` of at most `max_steps` (k and k_max).

    ValueError for an ending that is no episode of the task: no grip, or a fault of the cell.
    """
    if kind is Kind.DANGER:
        return -1.0
    if kind is Kind.LIMIT:
        return -0.5
    if kind is Kind.INSERTED:
        return 1.0 - step / max_steps
    raise ValueError(f"an episode that ended with {kind.value} has no reward; repeat it")
