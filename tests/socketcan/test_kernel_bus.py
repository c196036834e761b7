"""What a kernel CAN socket adds to the driver's bus: its buffer, its clock, its error frames."""

import subprocess

import can
import pytest

from drivers.errors import BusFaultError, LinkError
from drivers.interfaces import BusState, Freshness
from drivers.nrs.bus import open_bus
from drivers.nrs.can_sensor import CanSensor
from drivers.nrs.confinement import GOOD_FRAMES
from drivers.protocol.bus_address import BusAddress
from hil.app.run import Request, run
from hil_fixtures.testbed import shipped

pytestmark = pytest.mark.socketcan

VCAN0 = BusAddress("socketcan", "vcan0")


def error(kind, *data):
    return can.Message(
        arbitration_id=kind, data=bytes(data), is_error_frame=True, is_extended_id=False
    )


@pytest.fixture
def controller():
    """Stands for the CAN controller: vcan carries error frames, but makes none."""
    with open_bus(VCAN0, fd=False) as bus:
        yield bus


def test_three_thousand_unread_frames_are_kept(vcan, controller):
    for number in range(3000):
        data = number.to_bytes(8, "little")
        controller.send(can.Message(arbitration_id=0x7FF, data=data, is_extended_id=False))
    before = vcan.driver.health.foreign
    vcan.driver.poll(vcan.t)
    assert vcan.driver.health.foreign - before == 3000


def test_frames_carry_the_kernels_time_of_arrival(vcan, controller):
    for _ in range(20):
        vcan.step()
    stamps = []
    while (message := controller.recv(0)) is not None:
        stamps.append(message.timestamp)
    # Read in one go long after they came: a reader's clock would put them all at its own time.
    assert stamps == sorted(stamps)
    assert len(set(stamps)) == len(stamps)


def test_an_error_warning_is_told_and_readings_go_on(vcan, controller):
    vcan.stream()
    controller.send(error(0x204, 0, 0x04, 0, 0, 0, 0, 0, 96))
    assert vcan.read().freshness is Freshness.OK
    assert vcan.driver.health.bus is BusState.WARNING


def test_an_error_passive_controller_stops_readings_although_frames_come(vcan, controller):
    vcan.stream()
    controller.send(error(0x204, 0, 0x20, 0, 0, 0, 0, 128, 0))
    for _ in range(20):
        with pytest.raises(BusFaultError, match="error-passive"):
            vcan.read()


def test_readings_resume_once_the_bus_has_carried_enough_good_frames(vcan, controller):
    vcan.stream()
    controller.send(error(0x204, 0, 0x20, 0, 0, 0, 0, 128, 0))
    controller.send(error(0x204, 0, 0x40, 0, 0, 0, 0, 0, 0))
    carried = 0
    while carried + 16 < GOOD_FRAMES:
        with pytest.raises(BusFaultError, match="has carried"):
            vcan.read()
        carried += 16  # 8 pairs; STATUS and HEARTBEAT come on top
    vcan.step()
    vcan.step()
    reading = vcan.driver.read(vcan.t)
    assert reading.freshness is Freshness.OK
    assert vcan.driver.health.gaps == 0


def test_a_missing_acknowledge_says_what_to_check(vcan, controller):
    vcan.stream()
    controller.send(error(0x0A8, 0, 0, 0, 0x19))
    vcan.read()
    assert "check termination" in vcan.driver.health.last_error


def test_a_run_over_the_kernels_bus_records_what_one_on_the_virtual_bus_does(tmp_path):
    """The cell of the first in a process of its own: nothing but the kernel joins the two sides."""
    rig = shipped("ffc_ur5")
    results = {}
    for interface, layout in (("socketcan", "process"), ("virtual", "inline")):
        on_bus = rig.model_copy(update={"can": rig.can.model_copy(update={"interface": interface})})
        request = Request(on_bus, b"rig", 1, "FFC1", layout=layout, out=tmp_path / interface)
        results[interface] = run(request, lambda *_: None)
    kernel, virtual = results["socketcan"], results["virtual"]
    assert "CAN: socketcan vcan0" in kernel.description
    assert kernel.outcome == virtual.outcome
    assert kernel.digest == virtual.digest


def ip(*words):
    subprocess.run(["ip", "link", *words], check=True, timeout=30)


@pytest.fixture
def vcan7():
    ip("add", "dev", "vcan7", "type", "vcan")
    ip("set", "vcan7", "up")
    yield BusAddress("socketcan", "vcan7")
    ip("del", "vcan7")


@pytest.fixture
def listening(vcan7):
    sensor = CanSensor(*vcan7)
    sensor.connect()
    sensor.poll(0)
    yield sensor
    sensor.close()


def foreign_frame_is_heard(sensor, address, t):
    before = sensor.health.foreign
    with open_bus(address, fd=False) as peer:
        peer.send(can.Message(arbitration_id=0x7FF, is_extended_id=False))
        sensor.poll(t)
    return sensor.health.foreign == before + 1


def test_an_interface_that_went_down_is_named_and_heard_again_when_it_is_up(listening, vcan7):
    assert foreign_frame_is_heard(listening, vcan7, 1)
    ip("set", "vcan7", "down")
    listening.poll(2)
    assert "Network is down" in listening.health.last_error
    ip("set", "vcan7", "up")
    assert foreign_frame_is_heard(listening, vcan7, 3)


def test_an_interface_that_was_deleted_and_made_again_is_heard_again(listening, vcan7):
    ip("del", "vcan7")
    with pytest.raises(LinkError, match="vcan7"):  # the link cannot be opened anew yet
        listening.poll(2)
    ip("add", "dev", "vcan7", "type", "vcan")
    ip("set", "vcan7", "up")
    listening.connect()
    assert foreign_frame_is_heard(listening, vcan7, 3)
