"""The driver of a rig's force/torque sensor, on the wire that the rig names."""

from drivers.interfaces import ForceTorqueSensor
from drivers.nrs.can_sensor import CanSensor
from drivers.nrs.plausibility import OFF, Plausible
from drivers.nrs.tcp_sensor import TcpSensor
from drivers.nrs.tcp_session import Range
from hil.cell.errors import RigError
from hil.cell.rig import Rig
from hil.cell.rig.sensor import Sensor
from hil.cell.serve import Doors

NS = 1_000_000_000
BUFFERED = ("socketcan", "udp_multicast", "virtual")
"""Interfaces that keep frames while nobody polls; other adapters hold few, and need a thread."""


def wrist_sensor(rig: Rig, doors: Doors) -> ForceTorqueSensor:
    """The driver, not connected; raises RigError for a wire that the cell does not have."""
    return _on_tcp(rig, doors) if rig.sensor.wire == "tcp" else _on_can(rig, doors)


def _on_can(rig: Rig, doors: Doors) -> CanSensor:
    return CanSensor(
        doors.can.interface,
        doors.can.channel,
        node=rig.sensor.node,
        fd=rig.sensor.frames == "fd",
        max_age_ns=round(rig.limits.sample_age * NS),
        period_ns=round(NS / rig.sensor.rate),
        background=doors.can.interface not in BUFFERED,
        plausible=plausible(rig.sensor),
        bitrate=round(rig.can.bitrate),
        context=rig.can.context,
    )


def _on_tcp(rig: Rig, doors: Doors) -> TcpSensor:
    if doors.sensor is None:
        raise RigError("sensor.wire is tcp, but this cell's sensor serves CAN only")
    host, port = doors.sensor
    try:
        return TcpSensor(
            host,
            port,
            max_age_ns=round(rig.limits.sample_age * NS),
            period_ns=round(NS / rig.sensor.rate),
            rated=Range(rig.sensor.range_force, rig.sensor.range_torque),
            plausible=plausible(rig.sensor),
        )
    except ValueError as error:
        raise RigError(f"sensor.rate: {error}") from None


def plausible(sensor: Sensor) -> Plausible:
    """The rig's limits; none for an emulated sensor without noise, which does repeat itself."""
    errors = sensor.errors
    silent = sensor.preset == "nrs-6050-d80-quiet" or not (
        errors.noise_force and errors.noise_torque
    )
    return OFF if silent else Plausible(sensor.flat_samples, sensor.blank_samples)
