"""The controller's error tree."""

from enum import Enum


class ControlError(Exception):
    """Base of every error that the controller raises."""


class Trip(Enum):
    """Which limit ended the run."""

    FORCE = "force"
    NON_FINITE = "non-finite value"
    STALE = "sample age"
    WORKSPACE = "workspace"
    STEP = "set-point step"
    SPEED = "set-point speed"
    FOLLOWING = "following error"


class PartLostError(ControlError):
    """The jaws no longer feel the part that they were to hold."""


class DriftError(ControlError):
    """The sensor reads a force in free air that a zeroing would hide."""


class GuardTrip(ControlError):  # noqa: N818  the event's name in the field
    """A limit was passed; what was measured and what is allowed, in the SI unit of the quantity."""

    def __init__(self, trip: Trip, quantity: str, measured: float, allowed: float) -> None:
        super().__init__(f"{trip.value}: {quantity} is {measured:.6g}, allowed is {allowed:.6g}")
        self.trip = trip
        self.quantity = quantity
        self.measured = measured
        self.allowed = allowed
