"""The sensor driver against the emulated node over real buses: one contract for every bus."""

import can
import numpy as np
import pytest

from drivers.errors import (
    LinkError,
    NotReadyError,
    OverloadError,
    SensorResetError,
    StaleSampleError,
)
from drivers.interfaces import Freshness
from drivers.nrs.can_sensor import CanSensor
from drivers.nrs.plausibility import OFF
from drivers.protocol.nrs_command import Opcode, decode_command
from hil.cell.rig.sensor import Sensor
from hil.cell.sensor.node import SensorNode

PERIOD = 8_000_000
LOAD = np.array([1.5, -3.0, -9.81, 0.05, -0.1, 0.02])


class Cell:
    """Node and gateway in lockstep with a driver, period by period."""

    def __init__(self, gateway, sensor):
        self.node = SensorNode(sensor, np.random.default_rng(7))
        self.gateway = gateway
        self.t = 0
        self.load = LOAD

    def step(self, deliver=True):
        self.t += PERIOD
        for frame in self.gateway.receive():
            self.node.receive(frame, self.t)
        frames = self.node.advance(self.t, np.tile(self.load, (8, 1)))
        if deliver:
            self.gateway.send([frame for _, frame in frames])

    def until(self, condition, driver, limit=200):
        for _ in range(limit):
            self.step()
            driver.poll(self.t)
            if condition():
                return
        pytest.fail(f"nothing after {limit} periods: {driver.health}")


@pytest.fixture(params=["classic", "fd"])
def frames(request):
    return request.param


@pytest.fixture
def cell(gateway, frames):
    return Cell(gateway, Sensor(preset="nrs-6050-d80-quiet", frames=frames))


@pytest.fixture
def driver(cell, frames):
    sensor = CanSensor(*cell.gateway.address, fd=frames == "fd", plausible=OFF)
    sensor.connect()
    yield sensor
    sensor.close()


@pytest.fixture
def streaming(cell, driver):
    driver.start()
    cell.until(lambda: driver.ready, driver)
    return driver


def test_nothing_is_read_before_the_start(cell, driver):
    cell.step()
    with pytest.raises(NotReadyError):
        driver.read(cell.t)


def test_the_true_wrench_comes_over_the_wire_within_half_a_count(cell, streaming):
    cell.step()
    reading = streaming.read(cell.t)
    assert reading.wrench[:3] == pytest.approx(LOAD[:3], abs=0.0076)
    assert reading.wrench[3:] == pytest.approx(LOAD[3:], abs=0.000157)
    assert reading.freshness is Freshness.OK
    assert reading.age <= 1_000_000


def test_eight_samples_come_in_every_period(cell, streaming):
    streaming.read(cell.t)
    for _ in range(10):
        cell.step()
        assert len(streaming.read(cell.t).samples) == 8
    assert streaming.health.gaps == 0


def test_a_tare_brings_the_standing_load_to_zero(cell, streaming):
    streaming.begin_tare(50)
    cell.until(lambda: not streaming.tare_pending, streaming)
    cell.step()
    reading = streaming.read(cell.t)
    assert reading.tared
    assert reading.wrench == (0.0,) * 6


def test_silence_of_one_period_is_held_and_of_two_is_stale(cell, streaming):
    streaming.read(cell.t)
    cell.step(deliver=False)
    assert streaming.read(cell.t).freshness is Freshness.HELD
    cell.step(deliver=False)
    with pytest.raises(StaleSampleError):
        streaming.read(cell.t)
    cell.step()
    assert streaming.read(cell.t).freshness is Freshness.OK


def test_an_overload_is_refused_while_it_lasts(cell, streaming):
    cell.load = np.array([0.0, 0.0, -550.0, 0.0, 0.0, 0.0])
    cell.step()
    cell.load = LOAD
    cell.step()
    with pytest.raises(OverloadError):  # among the samples since the last read
        streaming.read(cell.t)
    cell.step()
    assert streaming.read(cell.t).freshness is Freshness.OK


def test_a_reboot_of_the_node_is_an_error_until_started_again(cell, streaming):
    cell.node.reboot(cell.t)
    cell.step()
    with pytest.raises(SensorResetError):
        streaming.read(cell.t)
    streaming.start()
    cell.until(lambda: streaming.ready, streaming)
    assert not streaming.read(cell.t).tared


def test_other_kinds_of_frames_never_count_as_samples(cell, streaming):
    address = cell.gateway.address
    before = streaming.health
    with can.Bus(**address.options()) as intruder:
        for kind in ({"is_extended_id": True}, {"is_remote_frame": True, "is_extended_id": False}):
            intruder.send(can.Message(arbitration_id=0x181, data=bytes(8), **kind))
        intruder.send(can.Message(arbitration_id=0x2, is_error_frame=True))
        intruder.send(can.Message(arbitration_id=0x7FF, is_extended_id=False))
        streaming.poll(cell.t)
    assert streaming.health.foreign - before.foreign == 4
    assert streaming.health.pairs == before.pairs
    assert streaming.health.last_error == "CAN error frame, class 0x2"


def test_the_background_thread_hears_the_node_and_ends_with_close(cell, frames):
    sensor = CanSensor(*cell.gateway.address, fd=frames == "fd", background=True)
    sensor.connect()
    try:
        sensor.start()
        for _ in range(50):
            cell.step()
        # Bench time stands still until the thread has handed over the heartbeat.
        while not (asked := cell.gateway.receive()):
            sensor.poll(cell.t)
        assert decode_command(asked[0].data).opcode == Opcode.TRANSMIT
        assert sensor.health.receiver_alive
    finally:
        sensor.close()
    assert not sensor.health.receiver_alive


def test_a_bus_that_cannot_be_opened_is_named():
    sensor = CanSensor("socketcan", "nosuch0")
    with pytest.raises(LinkError, match="socketcan 'nosuch0' cannot be opened"):
        sensor.connect()


def test_a_driver_that_is_not_connected_says_so():
    with pytest.raises(LinkError, match="connect"):
        CanSensor("virtual", "unused").poll(0)
