"""What a force law is given and what it answers, and what one controlled axis looks like.

x runs along the OUTWARD normal of the surface (m), and push >= 0 is what the environment does to
the tool (N): pressing harder means a smaller x. Force in and motion out over a position interface
is admittance, whatever the paper calls it.
"""

from typing import NamedTuple, Protocol


class AxisReading(NamedTuple):
    """One axis in one control period, as the devices told it.

    t: the arm's own time, ns. push: the sensor's samples since the last period, oldest first, N;
    empty when none came. position: measured, m; None when the arm did not tell.
    """

    t: int
    push: tuple[float, ...]
    position: float | None = None


class Reference(NamedTuple):
    """What the axis shall do.

    force: f_d, N, and its rate, N/s. speed: feed-forward along the normal (x_d' of Eq. 13), m/s.
    position: m, for position-controlled axes alone; None holds where the axis was reset.
    """

    force: float = 0.0
    rate: float = 0.0
    speed: float = 0.0
    position: float | None = None


class Felt(NamedTuple):
    """A reading that can be used: finite, in the sensor's range, at least one sample.

    push: mean of the samples, N. samples: themselves. touching: push is above the contact
    threshold. position: measured, m, or None. stale: readings were missing for so long that what
    was known of the contact holds no more.
    """

    push: float
    samples: tuple[float, ...]
    touching: bool
    position: float | None
    stale: bool


class Commanded(Protocol):
    """What has been commanded so far, after every bound."""

    @property
    def position(self) -> float:
        """The newest command, m."""
        ...

    @property
    def speed(self) -> float:
        """At which the newest command moved, m/s: a law's own state, so no bound winds it up."""
        ...

    def ago(self, delay: float) -> float:
        """The command in force so many seconds before the newest, between two interpolated, m."""
        ...


class ForceLaw(Protocol):
    """The part that differs from law to law: which speed would bring the force to its reference.

    Called once a period that has a usable reading, between touches too. Bounds, missing readings
    and the force stop are the `Governor`'s, so whatever is proposed here, what goes out is safe.
    """

    def reset(self, position: float) -> None:
        """Forget everything; the axis stands at this command, m."""
        ...

    def velocity(self, felt: Felt, motion: Commanded, reference: Reference) -> float:
        """The proposed speed, m/s; anything not finite counts as standing still."""
        ...


class AxisLaw(Protocol):
    """One axis under control, by force, position or neither."""

    def reset(self, position: float) -> None:
        """Begin at rest at this command (m or rad); clears a latched stop."""
        ...

    def step(self, reading: AxisReading, reference: Reference) -> float:
        """Change of the command for this period, m or rad, within every bound."""
        ...

    @property
    def velocity(self) -> float:
        """Of the command, m/s or rad/s."""
        ...
