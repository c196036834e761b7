"""Whether the rig's sensor streams, whole and at its rate, and whether its signal is a gauge's."""

from collections.abc import Iterator
from contextlib import closing
from time import monotonic_ns, sleep
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drivers.errors import DriverError, NotReadyError, StaleSampleError
from drivers.interfaces import ForceTorqueSensor, SensorHealth, Vector6
from hil.app.real import doors
from hil.app.wrist import wrist_sensor
from hil.cell.rig import Rig
from hil.cell.rig.sensor import Sensor
from hil.doctor.bus import kernel_interface
from hil.doctor.finding import Finding, Verdict

PATIENCE: Final = 5_000_000_000
"""Longest wait for the first sample, ns."""
SPAN: Final = 1_000_000_000
NAP: Final = 0.002


class Stretch(NamedTuple):
    """What came in `seconds`: samples (n, 6) in N and N·m, and what the wire did to them."""

    seconds: float
    samples: NDArray[np.float64]
    stale: int
    tared: bool
    lost: SensorHealth


def findings(rig: Rig) -> Iterator[Finding]:
    """The bus, where the kernel knows it, then the stream, then the signal."""
    can = rig.can
    if rig.sensor.wire == "can" and (can.interface in {"auto", "virtual"} or not _named(rig)):
        advice = "name can.interface and can.channel, as `hil up` prints them, or sensor.wire: tcp"
        yield Finding(
            "sensor", Verdict.WARN, f"the rig leaves its bus open ({can.interface})", advice
        )
        return
    if rig.sensor.wire == "can" and can.interface == "socketcan":
        yield kernel_interface(can)
    try:
        with closing(wrist_sensor(rig, doors(rig))) as sensor:
            sensor.connect()
            _begin(sensor)
            stretch = _listen(sensor)
    except DriverError as error:
        advice = "check power, cable, address, node id; an emulated cell must run by the wall clock"
        yield Finding("sensor", Verdict.FAIL, f"{type(error).__name__}: {error}", advice)
        return
    yield stream(stretch, rig.sensor.rate)
    yield signal(stretch, rig.sensor)
    yield zero(stretch, rig.sensor)


def _named(rig: Rig) -> bool:
    return rig.can.interface == "config" or bool(rig.can.channel)


def _begin(sensor: ForceTorqueSensor) -> None:
    """Start it and wait for samples; raises DriverError."""
    sensor.start()
    end = monotonic_ns() + PATIENCE
    while not sensor.ready:
        sensor.poll(monotonic_ns())
        if monotonic_ns() > end:
            raise NotReadyError(f"no sample within {PATIENCE / 1e9:g} s")
        sleep(NAP)


def _listen(sensor: ForceTorqueSensor) -> Stretch:
    """One second of samples, the host's clock in the arm's place; raises DriverError."""
    before, samples, stale, tared = sensor.health, list[Vector6](), 0, False
    start = now = monotonic_ns()
    while now < start + SPAN:
        sleep(NAP)
        now = monotonic_ns()
        try:
            reading = sensor.read(now)
        except StaleSampleError:
            stale += 1
            continue
        samples += reading.samples
        tared = reading.tared
    after = sensor.health
    lost = after._replace(
        pairs=after.pairs - before.pairs,
        gaps=after.gaps - before.gaps,
        torn=after.torn - before.torn,
        malformed=after.malformed - before.malformed,
    )
    return Stretch((now - start) * 1e-9, np.array(samples).reshape(-1, 6), stale, tared, lost)


def stream(stretch: Stretch, expected: float) -> Finding:
    """The measured rate, and frames that were lost, torn or bent."""
    lost = stretch.lost
    measured = lost.pairs / stretch.seconds
    found = (
        f"{measured:.0f} samples/s of {expected:g}, {lost.gaps} lost, {lost.torn} torn, "
        f"{lost.malformed} malformed, {stretch.stale} looks found none fresh"
    )
    if abs(measured - expected) > 0.05 * expected:
        advice = "set sensor.rate to what the sensor sends, or look for who else sets its rate"
        return Finding("sensor stream", Verdict.FAIL, found, advice)
    if lost.gaps or lost.torn or lost.malformed or stretch.stale:
        advice = "frames are lost or late: bit rate, termination, bus load, host jitter"
        return Finding("sensor stream", Verdict.WARN, found, advice)
    return Finding("sensor stream", Verdict.OK, found)


def signal(stretch: Stretch, sensor: Sensor) -> Finding:
    """Noise of each axis over a second, against the rig's; a flat line raises in the driver."""
    sigma = stretch.samples.std(axis=0)
    force, torque = float(sigma[:3].max()), float(sigma[3:].max())
    found = f"noise {force:.3g} N, {torque:.3g} N·m (1 sigma, the noisiest axes)"
    errors = sensor.errors
    expected = (
        errors.noise_force + sensor.resolution_force,
        errors.noise_torque + sensor.resolution_torque,
    )
    if force > 3 * expected[0] or torque > 3 * expected[1]:
        advice = "stop what moves or shakes the arm; check shield and ground"
        return Finding("sensor signal", Verdict.WARN, found, advice)
    return Finding("sensor signal", Verdict.OK, found)


def zero(stretch: Stretch, sensor: Sensor) -> Finding:
    """How far the mean lies from zero; a run tares in free air before it touches anything."""
    mean = stretch.samples.mean(axis=0)
    force, torque = float(np.abs(mean[:3]).max()), float(np.abs(mean[3:]).max())
    tared = "tared" if stretch.tared else "not tared"
    found = f"mean up to {force:.2f} N, {torque:.3f} N·m, {tared}"
    if force > 0.2 * sensor.range_force or torque > 0.2 * sensor.range_torque:
        advice = "more than a tool weighs: is something pressed, or was it overloaded?"
        return Finding("sensor zero", Verdict.WARN, found, advice)
    return Finding("sensor zero", Verdict.OK, found)
