"""Which bus the gateway takes, and that cantools can read what is on it."""

from pathlib import Path

import can
import cantools
import numpy as np
import pytest
from can.util import channel2int

import drivers.protocol
from drivers.nrs.bus import open_bus
from drivers.protocol.bus_address import BusAddress
from drivers.protocol.frame import CanFrame
from drivers.protocol.nrs_can import Identifiers
from drivers.protocol.nrs_command import Command, Opcode, encode_command
from hil.cell.errors import DoorError
from hil.cell.rig.sensor import CanBus, Sensor
from hil.cell.sensor.can_interfaces import up_can_interfaces
from hil.cell.sensor.gateway import choose, open_gateway
from hil.cell.sensor.node import SensorNode


@pytest.fixture(
    params=["virtual", "udp_multicast", pytest.param("socketcan", marks=pytest.mark.socketcan)]
)
def gateway(request):
    gateway = open_gateway(
        CanBus(interface=request.param), across_processes=request.param != "virtual", fd=True
    )
    yield gateway
    gateway.close()


@pytest.fixture
def tap(gateway):
    with open_bus(gateway.address, fd=True) as bus:
        yield bus


def test_auto_takes_a_kernel_interface_where_one_is_up():
    assert choose(CanBus(), False, ["can0", "vcan0"]) == BusAddress("socketcan", "can0")


@pytest.mark.parametrize(("across", "interface"), [(False, "virtual"), (True, "udp_multicast")])
def test_auto_without_kernel_can_depends_on_where_the_driver_is(across, interface):
    one, two = (choose(CanBus(), across, []) for _ in range(2))
    assert one.interface == interface
    assert one.channel != two.channel or interface == "udp_multicast"


def test_a_channel_of_ones_own_has_no_number_for_a_log_to_keep():
    """Its last hex digits were one in ten times more than the 16 bits that a BLF file has."""
    drawn = [choose(CanBus(), False, []).channel for _ in range(200)]
    assert {channel2int(channel) for channel in drawn} == {None}


def test_an_explicit_channel_is_kept():
    rig = CanBus(interface="socketcan", channel="can7")
    assert choose(rig, False, []) == BusAddress("socketcan", "can7")


def test_socketcan_without_an_interface_says_so():
    with pytest.raises(DoorError, match="no kernel CAN interface is up"):
        choose(CanBus(interface="socketcan"), False, [])


def test_a_virtual_bus_between_processes_is_refused():
    with pytest.raises(DoorError, match="ends at the process"):
        choose(CanBus(interface="virtual"), True, [])


def test_a_bus_that_cannot_be_opened_is_one_line():
    with pytest.raises(DoorError, match="cannot open socketcan 'nosuch0'") as failure:
        open_gateway(CanBus(interface="socketcan", channel="nosuch0"), across_processes=False)
    assert "\n" not in str(failure.value)


def test_a_udp_channel_without_a_port_is_one_line():
    with pytest.raises(DoorError, match="is not 'group:port'"):
        open_gateway(CanBus(interface="udp_multicast", channel="239.1.2.3"), across_processes=True)


def test_up_can_interfaces_are_found_by_type_and_flags(tmp_path):
    for name, kind, flags in (("eth0", 1, 0x1003), ("vcan0", 280, 0x41), ("can1", 280, 0x40)):
        (tmp_path / name).mkdir()
        (tmp_path / name / "type").write_text(f"{kind}\n")
        (tmp_path / name / "flags").write_text(f"{flags:#x}\n")
    assert up_can_interfaces(tmp_path) == ["vcan0"]
    assert up_can_interfaces(tmp_path / "absent") == []


def test_frames_arrive_whole_and_in_order(gateway, tap):
    frames = [CanFrame(0x181, bytes([n] * 8)) for n in range(20)]
    frames += [CanFrame(0x1A1, bytes(24), fd=True), CanFrame(0x701, b"\x05")]
    gateway.send(frames)
    got = [tap.recv(1) for _ in frames]
    assert [CanFrame(m.arbitration_id, bytes(m.data), m.is_fd) for m in got] == frames
    assert all(m.dlc == len(m.data) and not m.is_extended_id for m in got)


def test_a_message_that_was_received_is_not_changed_by_the_next_one(gateway, tap):
    gateway.send([CanFrame(0x181, b"first  ."), CanFrame(0x181, b"second .")])
    assert [bytes(tap.recv(1).data) for _ in range(2)] == [b"first  .", b"second ."]


def test_the_gateway_hears_others_and_not_itself(gateway, tap):
    gateway.send([CanFrame(0x181, bytes(8))])
    tap.send(can.Message(arbitration_id=0x201, data=b"\x07", is_extended_id=False))
    tap.send(can.Message(arbitration_id=0x201, data=b"\x07", is_extended_id=True))
    assert gateway.receive() == [CanFrame(0x201, b"\x07")]
    assert gateway.receive() == []


def test_the_gateway_says_where_it_is(gateway):
    assert gateway.address.interface in gateway.describe()
    assert gateway.address.channel in gateway.describe()


def test_cantools_reads_every_frame_of_the_live_bus(gateway, tap):
    dbc = cantools.database.load_file(
        Path(drivers.protocol.__file__).with_name("nrs.dbc"), strict=True
    )
    node = SensorNode(Sensor(preset="nrs-6050-d80-quiet"), np.random.default_rng(0))
    tap.send(
        can.Message(
            arbitration_id=0x201,
            data=encode_command(Identifiers.of(1), Command(Opcode.TRANSMIT, 1, (1,))).data,
            is_extended_id=False,
        )
    )
    seen = {}
    load = np.tile([0.0, 0.0, -9.81, 0.1, 0.0, 0.0], (8, 1))
    for period in range(1, 60):
        t = period * 8_000_000
        if period == 50:
            for frame in gateway.receive():
                node.receive(frame, t)
        gateway.send([frame for _, frame in node.advance(t, load)])
        while (message := tap.recv(0)) is not None:
            name = dbc.get_message_by_frame_id(message.arbitration_id).name
            seen[name] = dbc.decode_message(message.arbitration_id, message.data)
    seen.pop("NRS1_CMD", None)  # udp_multicast gives the tap its own command back
    assert set(seen) == {
        f"NRS1_{name}" for name in ("FORCE", "TORQUE", "STATUS", "REPLY", "HEARTBEAT")
    }
    assert seen["NRS1_FORCE"]["Fz"] == pytest.approx(-9.81, abs=0.0076)
    assert seen["NRS1_TORQUE"]["Tx"] == pytest.approx(0.1, abs=0.00016)
    assert seen["NRS1_REPLY"]["R_Result"] == "OK"
