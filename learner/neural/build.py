"""From a neural learner's settings to the learner, loading torch no earlier than that."""

from collections.abc import Sequence
from importlib.util import find_spec

import numpy as np

from learner.errors import MissingExtraError
from learner.grid import Grid
from learner.interface import Learner
from learner.neural.settings import Method, Neural

NEEDED = ("torch", "stable_baselines3", "gymnasium")


def check_extra(name: str, needed: Sequence[str] = NEEDED) -> None:
    """MissingExtraError, before anything runs, unless this learner's packages are installed."""
    missing = [package for package in needed if find_spec(package) is None]
    if missing:
        raise MissingExtraError(f"learner {name} needs {', '.join(missing)}: run `make baselines`")


def neural(grid: Grid, settings: Neural, rng: np.random.Generator) -> Learner:
    """The learner that these settings ask for."""
    # Imported here: they are an extra, and take seconds to load.
    from learner.neural.dql import DqlLearner  # noqa: PLC0415
    from learner.neural.on_policy import OnPolicyLearner  # noqa: PLC0415
    from learner.neural.pg import PgLearner  # noqa: PLC0415

    if settings.method is Method.DQL:
        return DqlLearner(grid, settings, rng)
    if settings.method is Method.PG:
        return PgLearner(grid, settings, rng)
    return OnPolicyLearner(grid, settings, rng)
