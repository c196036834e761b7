"""Faults of whoever chooses the search's steps: stale, corrupt or slow."""

from collections import deque
from typing import Final, Protocol, cast

from controller.action import Action, Answer, Observation, Pending, Policy
from hil.app.host_faults import HostFaults

NS: Final = 1_000_000_000
REMEMBERED: Final = 10_000
_WRONG: Final = {"nan": float("nan"), "out_of_range": 17, "none": None}
"""What no action filter may let through. None is an answer, and means giving up."""


class Choosing:
    """What happens between an observation and the action that comes of it (L1, L2, L5)."""

    def __init__(self, faults: HostFaults) -> None:
        self._faults = faults
        self._seen: deque[Observation] = deque(maxlen=REMEMBERED)
        self._asked: int | None = None

    def thinks(self) -> bool:
        """Whether the answer is not there yet; asked once a period."""
        slow, now = self._faults.of("L5"), self._faults.now
        if self._asked is None:
            self._asked = now
        for one in slow:
            one.felt(now, "the choice comes late")
        late = max((round(one.fault.number("delay") * NS) for one in slow), default=0)
        if now - self._asked < late:
            return True
        self._asked = None
        return False

    def seen(self, observation: Observation) -> Observation:
        """What the chooser gets to see."""
        self._seen.append(observation)
        for one in self._faults.of("L1"):
            old = self._seen[-min(len(self._seen), 1 + int(one.fault.number("age")))]
            if old is not observation:
                one.felt(self._faults.now, "chosen by an old observation")
            observation = old
        return observation

    def given(self, action: Answer, observation: Observation) -> Answer:
        """What reaches the controller, whatever its type says."""
        for one in self._faults.of("L2"):
            value = one.fault.word("value")
            wrong = _away(observation) if value == "adversarial" else _WRONG[value]
            one.felt(self._faults.now, f"action {wrong!r}")
            action = cast("Answer", wrong)  # the fault is that it is none
        return action


def _away(observation: Observation) -> Action:
    """The step that leads furthest off the middle."""
    return Action.PLUS_X if observation.x >= 0.0 else Action.MINUS_X


class Pieces(Protocol):
    """A learner of several pieces, some of which may fail before it is asked."""

    def fail(self) -> None: ...


class FaultyPolicy:
    """A policy behind faults, and before it those of the learner that it asks."""

    def __init__(self, policy: Policy, faults: HostFaults, learner: Pieces | None = None) -> None:
        self._policy, self._choosing, self._learner = policy, Choosing(faults), learner

    def choose(self, observation: Observation) -> Answer:
        if self._choosing.thinks():
            return Pending.PENDING
        if self._learner is not None:
            self._learner.fail()
        chosen = self._policy.choose(self._choosing.seen(observation))
        return self._choosing.given(chosen, observation)
