"""The connector's terminals: dry friction against the cable's way in and out.

A bristle law: a spring that drags its foot along once it carries the limit. Unlike a sign or tanh
of the velocity it holds at rest and stays stable on a light cable stepped at 1 kHz.
"""

from hil.cell.rig.parts import Connector

STIFFNESS = 20e3
"""Bristle stiffness, N/m (assumed: full grip after 0.2 mm)."""


class TerminalFriction:
    """Friction whose limit ramps up with depth; keeps the bristle's foot."""

    def __init__(self, connector: Connector) -> None:
        self._force = connector.mating_force
        self._start = connector.mating_start
        self._ramp = connector.mating_ramp
        self._foot = 0.0

    @property
    def start(self) -> float:
        """Depth below which the terminals do nothing, m."""
        return self._start

    def release(self) -> None:
        """Let go: the bristle forgets its foot."""
        self._foot = 0.0

    def force(self, z: float) -> float:
        """Force along z on a tip at height z, N; positive resists going in."""
        limit = self.limit(-z)
        pull = STIFFNESS * (self._foot - z)
        if abs(pull) > limit:
            pull = limit if pull > 0 else -limit
            self._foot = z + pull / STIFFNESS
        return pull

    def limit(self, depth: float) -> float:
        """Largest force at `depth`, N."""
        return self._force * min(1.0, max(0.0, (depth - self._start) / self._ramp))
