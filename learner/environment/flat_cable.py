"""The environment: an episode of the search task, one action a step, Eq. 4's reward."""

from collections.abc import Mapping
from typing import Protocol, SupportsFloat, runtime_checkable

import gymnasium
import numpy as np

from controller.action import Action, Observation
from controller.outcome import Kind
from learner.environment.picture import Picture, Pixels
from learner.environment.spaces import Seen, actions, encoded, observations
from learner.grid import Cell
from learner.task import reward
from learner.worlds.interface import World
from learner.worlds.named import model
from learner.worlds.slot import SlotWorld


@runtime_checkable
class Closes(Protocol):
    """A world with something to give back: a cell, drivers, a thread."""

    def close(self) -> None: ...


@runtime_checkable
class Shows(Protocol):
    """A world that knows the truth; a picture then shows it. No observation does."""

    @property
    def error(self) -> tuple[float, float, float]:
        """From the slot to the tip, in steps."""
        ...


class FlatCable(gymnasium.Env[Seen, np.int64]):
    """Search for the slot in a box of poses, by six steps.

    `reset(seed=N)` makes a cell of its own: where the slot is, how the part lies in the jaws. A
    plain `reset()` begins the next episode on it; `options={"regrip": True}` has the jaws take
    another part first. `terminated`: inserted or danger. `truncated`: k_max steps, which pay -0.5.
    info: "ending" ("" while the episode goes on) and "cell", the pose in steps.
    """

    metadata = {  # noqa: RUF012  # gymnasium's own declaration
        "render_modes": ["rgb_array"],
        "render_fps": 10,
    }

    def __init__(
        self, world: str | World = "ffc", *, forces: bool = False, render_mode: str | None = None
    ) -> None:
        """world: a name (see `learner.worlds.named`) or any world of yours. forces: show them too.

        UnknownWorldError for a name that is none, ValueError for a render mode.
        """
        if render_mode not in {None, *self.metadata["render_modes"]}:
            raise ValueError(f"render_mode is 'rgb_array' or None, found {render_mode!r}")
        self.world = SlotWorld(model(world)) if isinstance(world, str) else world
        self.forces, self.render_mode = forces, render_mode
        self.observation_space = observations(forces=forces)
        self.action_space = actions()
        self._picture = Picture(self.world.grid)
        self._fresh = True

    def reset(
        self, *, seed: int | None = None, options: Mapping[str, object] | None = None
    ) -> tuple[Seen, dict[str, object]]:
        """Begin an episode; see the class for what `seed` and `options` change."""
        super().reset(seed=seed)
        if seed is not None or self._fresh:
            self.world.reset(self.np_random)
            self._fresh = False
        if (options or {}).get("regrip"):
            self.world.regrip()
        seen = self.world.begin()
        self._steps = 0
        self._picture.begin(self._cell(seen))
        return self._shown(seen), self._told(seen, None)

    def step(
        self, action: np.int64 | int
    ) -> tuple[Seen, SupportsFloat, bool, bool, dict[str, object]]:
        """One step of Eq. 2; ValueError for an action that is none of the six."""
        if not self.action_space.contains(np.int64(action)):
            raise ValueError(f"an action is 0 to {len(Action) - 1}, found {action!r}")
        met = self.world.step(Action(int(action)))
        self._steps += 1
        ending = met.ending
        self._picture.step(self._cell(met.observation), ending)
        paid = 0.0 if ending is None else reward(ending, self._steps, self.world.max_steps)
        over, cut = ending in {Kind.INSERTED, Kind.DANGER}, ending is Kind.LIMIT
        told = self._told(met.observation, ending)
        return self._shown(met.observation), paid, over, cut, told

    def render(self) -> Pixels | None:
        """The box from above and its turns, (h, w, 3) uint8; None without a render mode."""
        if self.render_mode is None:
            return None
        return self._picture.drawn(self.world.error if isinstance(self.world, Shows) else None)

    def close(self) -> None:
        """Give back what the world holds."""
        if isinstance(self.world, Closes):
            self.world.close()

    def _cell(self, seen: Observation) -> Cell:
        return self.world.grid.cell(seen)

    def _shown(self, seen: Observation) -> Seen:
        return encoded(self.world.grid, seen, forces=self.forces)

    def _told(self, seen: Observation, ending: Kind | None) -> dict[str, object]:
        cell = np.array(self._cell(seen))
        return {"ending": "" if ending is None else ending.value, "cell": cell}
