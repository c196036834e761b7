"""A rig of real devices: what it must name, and where it is refused."""

import can
import pytest

from drivers.errors import LinkError
from drivers.nrs.bus import open_bus, options
from drivers.protocol.bus_address import BusAddress
from hil.app.real import RealCell, doors
from hil.app.wrist import wrist_sensor
from hil.cell.assemble import serve
from hil.cell.errors import CellError, RigError
from hil.cell.rig import parse

REAL = """
name: cell_a
rig: real
clock: wall
robot: {host: 192.0.2.10}
"""


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("clock: lockstep", "clock must be wall"),
        ("", "can.interface must be the adapter's"),
        ("can: {interface: virtual, channel: x}", "can.interface must be the adapter's"),
        ("can: {interface: pcan}", "can.channel must say which pcan"),
        ("sensor: {wire: tcp}", "sensor.tcp.host must be the sensor's address"),
        ("sensor: {wire: tcp, tcp: {host: h, port: 0}}", "sensor.tcp.port must be a real port"),
        ("robot: {ports: {rtde: 0}}", "robot.ports.rtde must be a real port"),
        ("can: {interface: socketcan, context: a}", "interface 'config' only"),
        ("can: {interface: sockectan}", "can.interface: Input should be"),
        ("sensor: {flat_samples: 1}", "one sample is no run"),
        ("rig: reel", "rig: Input should be 'emulated' or 'real'"),
    ],
)
def test_what_a_real_rig_leaves_open_is_named(text, expected):
    key = text.partition(":")[0]
    kept = "\n".join(line for line in REAL.splitlines() if not key or not line.startswith(key))
    with pytest.raises(RigError) as refusal:
        parse(f"{kept}\n{text}")
    assert expected in str(refusal.value)


@pytest.mark.parametrize(
    "text",
    [
        "can: {interface: socketcan, channel: can0}",
        "can: {interface: config, context: cell_a}",
        "sensor: {wire: tcp, tcp: {host: 192.0.2.20}}",
    ],
)
def test_a_real_rig_keeps_its_addresses_and_gives_drivers_at_them(text):
    rig = parse(REAL + text)
    assert rig.on_free_ports() == rig
    assert doors(rig).ports["rtde"] == 30004
    assert doors(rig).host == "192.0.2.10"
    wrist_sensor(rig, doors(rig)).close()


def test_nothing_emulated_stands_in_for_a_real_rig():
    rig = parse(REAL + "can: {interface: socketcan, channel: can0}")
    with pytest.raises(RigError, match="names real devices"):
        serve(rig, 1, across_processes=False)
    with pytest.raises(RigError, match="wall clock, not lockstep"):
        RealCell(rig, "lockstep")
    with pytest.raises(CellError, match="unknown"):
        RealCell(rig, "wall").truth()


def test_an_adapter_gets_the_rigs_bit_rate_and_the_kernels_interface_does_not():
    pcan = options(BusAddress("pcan", "PCAN_USBBUS1"), False, 500_000, None)
    assert pcan == {"interface": "pcan", "channel": "PCAN_USBBUS1", "bitrate": 500_000}
    assert "bitrate" not in options(BusAddress("socketcan", "can0"), False, 500_000, None)


def test_python_cans_configuration_names_the_bus_by_its_context(tmp_path, monkeypatch):
    (tmp_path / "can.conf").write_text(
        "[default]\ninterface = socketcan\nchannel = none\n"
        "[cell_a]\ninterface = virtual\nchannel = of-cell-a\n"
    )
    monkeypatch.setenv("HOME", str(tmp_path))  # python-can looks there at every opening
    with (
        open_bus(BusAddress("config", ""), fd=False, context="cell_a") as bus,
        can.Bus(interface="virtual", channel="of-cell-a") as peer,
    ):
        peer.send(can.Message(arbitration_id=0x181, is_extended_id=False))
        message = bus.recv(0)
        assert message is not None
        assert message.arbitration_id == 0x181
    with pytest.raises(LinkError, match="CAN config"):
        open_bus(BusAddress("config", ""), fd=False)
