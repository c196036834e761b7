"""The near side's one error tree: what drivers raise when cell, link or caller is wrong."""


class DriverError(Exception):
    """Base of every error that a driver raises."""


class ProtocolError(DriverError):
    """The peer sent bytes that its protocol does not allow."""


class LinkError(DriverError):
    """The link is down, was refused or was cut."""


class LinkTimeoutError(LinkError, TimeoutError):
    """The peer said nothing for longer than the wall-clock limit."""


class RecipeError(DriverError):
    """The controller refused an RTDE recipe: unknown field, or an input another client owns."""


class RobotStateError(DriverError):
    """The robot cannot follow commands: program not running, wrong mode."""


class ProtectiveStopError(RobotStateError):
    """The robot's safety system stopped it; only a person or supervisor may release it."""


class SensorError(DriverError):
    """The force/torque sensor cannot give a wrench to control on."""


class NotReadyError(SensorError):
    """The sensor has not been started or has no complete sample yet."""


class StaleSampleError(SensorError, TimeoutError):
    """The newest complete sample is older than the limit, or the counter stands still."""


class OverloadError(SensorError):
    """The wrench is outside the rated range or clipped: a bound, not a measurement."""


class BusFaultError(SensorError):
    """The CAN controller is error-passive or off the bus, or has only just come back."""


class FlatSignalError(SensorError):
    """Sample after sample is the same: gauges make noise, so somebody repeats an old value."""


class BlankSignalError(FlatSignalError):
    """Samples are zero on every axis: what a dead amplifier or an empty buffer looks like."""


class SensorResetError(SensorError):
    """The node restarted: its tare is gone, so its readings mean something else."""


class SensorAxesError(SensorError):
    """The sensor's axes, signs or scale are not those that the arm moves along."""


class CommandRefusedError(SensorError):
    """The node answered a command with an error code, or not at all."""
