"""Where every part is, and what closing and opening the jaws does to it.

Gripping is an event, not contact physics: jaws that close near enough to a waiting part hold it
where its fixture's play had left it. Shared by all plants.
"""

from dataclasses import dataclass
from enum import Enum
from math import cos, dist, pi, remainder, sin
from typing import TypeAlias

import numpy as np

from hil.cell.rig import Rig
from hil.cell.rig.parts import Connector, Fixture, Part

Stage: TypeAlias = tuple[float, float, float, float]

CAPTURE_ROTATION = 0.1
"""Jaws turned further than this against a part catch nothing, rad (assumed)."""
SEATED_DEPTH = 0.5e-3
"""A part let go deeper than this stays in the connector, m (assumed)."""


class Whereabouts(Enum):
    """FIXTURE: waiting. JAWS: gripped. CONNECTOR: left in the slot. DROPPED: gone."""

    FIXTURE = "fixture"
    JAWS = "jaws"
    CONNECTOR = "connector"
    DROPPED = "dropped"


@dataclass(frozen=True, slots=True)
class Grip:
    """A part in the jaws: its tip against the TCP, in the turned tool's axes, m and rad about z."""

    name: str
    x: float
    y: float
    z: float
    theta: float


class Jaws:
    """Two jaws and the parts they may take; play is drawn anew from `rng` at every grip."""

    def __init__(self, rig: Rig, rng: np.random.Generator) -> None:
        self._fixture = rig.fixture
        self.places = {part.name: place(part, rig.connector) for part in rig.fixture.parts}
        self._rng = rng
        self.reset()

    def reset(self) -> None:
        """Open, every part in its fixture."""
        self.whereabouts = dict.fromkeys(self.places, Whereabouts.FIXTURE)
        self.closed = False
        self.grip: Grip | None = None

    def move(self, closed: bool, stage: Stage, depth: float) -> bool:
        """Close or open at `stage`, the held tip at `depth` m; True if what is held changed."""
        if closed == self.closed:
            return False
        self.closed = closed
        held = self.grip
        if closed:
            self.grip = self._take(stage)
        elif held is not None:
            self.whereabouts[held.name] = self._left(held.name, stage, depth)
            self.grip = None
        return held is not self.grip

    def _take(self, stage: Stage) -> Grip | None:
        for name, where in self.whereabouts.items():
            if where is Whereabouts.FIXTURE and self._reaches(self.places[name], stage):
                self.whereabouts[name] = Whereabouts.JAWS
                return seen_from(
                    stage, name, with_play(self.places[name], self._fixture, self._rng)
                )
        return None

    def _reaches(self, nominal: Stage, stage: Stage) -> bool:
        near = dist(nominal[:3], stage[:3]) <= self._fixture.capture
        return near and abs(remainder(nominal[3] - stage[3], 2 * pi)) <= CAPTURE_ROTATION

    def _left(self, name: str, stage: Stage, depth: float) -> Whereabouts:
        if self._reaches(self.places[name], stage):
            return Whereabouts.FIXTURE
        return Whereabouts.CONNECTOR if depth > SEATED_DEPTH else Whereabouts.DROPPED


def place(part: Part, connector: Connector) -> Stage:
    """A part's nominal tip in the task frame, from its place in the robot's base frame."""
    x, y, z = (p - c for p, c in zip(part.position, connector.position, strict=True))
    c, s = cos(connector.rotation), sin(connector.rotation)
    return c * x + s * y, c * y - s * x, z, remainder(part.rotation - connector.rotation, 2 * pi)


def with_play(nominal: Stage, fixture: Fixture, rng: np.random.Generator) -> Stage:
    """A true pose in the fixture: uniform over the play along the fixture's axes and about z."""
    u, v, w = rng.uniform(-0.5, 0.5, 3).tolist()
    x, y, z, theta = nominal
    c, s = cos(theta) * fixture.play, sin(theta) * fixture.play
    return x + c * u - s * v, y + s * u + c * v, z, theta + fixture.play_rotation * w


def seen_from(stage: Stage, name: str, tip: Stage) -> Grip:
    """The grip that holds a tip at `tip` when the TCP is at `stage`."""
    dx, dy, dz = tip[0] - stage[0], tip[1] - stage[1], tip[2] - stage[2]
    c, s = cos(stage[3]), sin(stage[3])
    theta = remainder(tip[3] - stage[3], 2 * pi)
    return Grip(name, c * dx + s * dy, c * dy - s * dx, dz, theta)


def tip_of(stage: Stage, grip: Grip) -> Stage:
    """The gripped tip in the task frame when nothing bends; inverse of `seen_from`."""
    c, s = cos(stage[3]), sin(stage[3])
    x = stage[0] + c * grip.x - s * grip.y
    y = stage[1] + s * grip.x + c * grip.y
    return x, y, stage[2] + grip.z, stage[3] + grip.theta
