"""Making the environment known to gymnasium, when asked to: importing this changes nothing."""

from typing import Final

import gymnasium

NAME: Final = "hil/FlatCable-v0"


def register() -> str:
    """From now on `gymnasium.make(NAME, world="ffc")` and `make_vec` work in this process; NAME.

    No step limit of gymnasium's own: k_max is the task's. Calling it again does nothing.
    """
    if NAME not in gymnasium.registry:
        gymnasium.register(NAME, entry_point="learner.environment.flat_cable:FlatCable")
    return NAME
