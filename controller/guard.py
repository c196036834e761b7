"""The limits that end a run safely, checked every period before and after the phase."""

from dataclasses import dataclass, replace
from math import dist, isfinite

from controller.cycle import Cycle
from controller.errors import GuardTrip, Trip
from controller.place import Place
from drivers.interfaces import Vector6

_FORCES = (("|fx|", 0), ("|fy|", 1), ("|fz|", 2), ("|tau_z|", 5))
_AXES = ("|x|", "|y|", "|z|")


@dataclass(frozen=True, slots=True)
class Limits:
    """force_bound: the paper's f_b on |fx|, |fy|, |fz| (N) and |tau_z| (N·m), on the 8 ms mean.

    workspace: half widths around the connector, task frame, m. step, step_rotation: largest
    set-point change of one period, m and rad. speed: of the set-point, m/s. sample_age: ns.
    following: how far the arm may be from the last set-point, m.
    """

    force_bound: tuple[float, float, float, float] = (1.5, 1.5, 10.0, 1.0)
    workspace: tuple[float, float, float] = (0.25, 0.25, 0.25)
    step: float = 3e-3
    step_rotation: float = 0.0174532925199433
    speed: float = 0.3
    sample_age: int = 10_000_000
    following: float = 0.05

    def relaxed(self, factor: float = 3.0) -> "Limits":
        """The same with wider force bounds: for leaving a contact, or where force is no verdict."""
        fx, fy, fz, tau_z = (bound * factor for bound in self.force_bound)
        return replace(self, force_bound=(fx, fy, fz, tau_z))

    def leaving(self, wrench: Vector6) -> "Limits":
        """The same for drawing back from what pushes with `wrench`: it must not push much more."""
        forces = zip(_FORCES, self.force_bound, strict=True)
        share = max(abs(wrench[axis]) / bound for (_, axis), bound in forces)
        return self.relaxed(max(3.0, 1.25 * share))


class Guard:
    """Raises GuardTrip on the first limit passed.

    Nothing is clipped: a set-point beyond a limit is a fault of the phase that asked for it, and a
    clipped one would leave phase and arm with different ideas of where the arm is.
    """

    __slots__ = ("_last", "_limits", "_reach")

    def __init__(self, limits: Limits, period: int) -> None:
        """period: of the control loop, ns."""
        self._limits = limits
        self._reach = limits.speed * period * 1e-9
        self._last: Place | None = None

    def check(self, cycle: Cycle) -> None:
        """What was measured: finite, fresh, within the force bound, and where it was sent."""
        _finite("wrench", cycle.wrench)
        _finite("stage", cycle.stage)
        limits = self._limits
        if cycle.reading.age > limits.sample_age:
            raise GuardTrip(Trip.STALE, "age (ns)", cycle.reading.age, limits.sample_age)
        for (name, axis), bound in zip(_FORCES, limits.force_bound, strict=True):
            if abs(cycle.wrench[axis]) > bound:
                raise GuardTrip(Trip.FORCE, name, abs(cycle.wrench[axis]), bound)
        behind = dist(cycle.stage[:3], self._last[:3]) if self._last is not None else 0.0
        if behind > limits.following:
            raise GuardTrip(Trip.FOLLOWING, "way to the set-point", behind, limits.following)

    def check_setpoint(self, setpoint: Place, stage: Place) -> None:
        """What is about to be sent; the first set-point is held against the actual stage."""
        _finite("set-point", setpoint)
        for name, value, allowed in zip(_AXES, setpoint, self._limits.workspace, strict=False):
            if abs(value) > allowed:
                raise GuardTrip(Trip.WORKSPACE, name, abs(value), allowed)
        self._check_step(setpoint, self._last or stage)
        self._last = setpoint

    def _check_step(self, setpoint: Place, last: Place) -> None:
        limits = self._limits
        step = dist(setpoint[:3], last[:3])
        if step > limits.step:
            raise GuardTrip(Trip.STEP, "step", step, limits.step)
        if step > self._reach:
            raise GuardTrip(Trip.SPEED, "way of one period", step, self._reach)
        turn = abs(setpoint.theta - last.theta)
        if turn > limits.step_rotation:
            raise GuardTrip(Trip.STEP, "turn", turn, limits.step_rotation)


def _finite(quantity: str, values: Vector6 | Place) -> None:
    # One pass in the usual case: a sum is finite only if every term is.
    if isfinite(sum(values)):
        return
    for value in values:
        if not isfinite(value):
            raise GuardTrip(Trip.NON_FINITE, quantity, value, 0.0)
