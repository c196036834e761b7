"""What anybody can send to a multicast group ends no cell."""

import socket

import pytest

from drivers.nrs.bus import open_bus, send
from drivers.protocol.frame import CanFrame
from hil.cell.rig.sensor import CanBus
from hil.cell.sensor.gateway import open_gateway


@pytest.fixture
def said():
    return []


@pytest.fixture
def gateway(said):
    bus = CanBus(interface="udp_multicast")
    gateway = open_gateway(bus, across_processes=True, say=said.append)
    yield gateway
    gateway.close()


@pytest.fixture
def shout(gateway):
    """Sends a datagram to the bus's group."""
    group, _, port = gateway.address.channel.partition(":")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
        yield lambda octets: sender.sendto(octets, (group, int(port)))


@pytest.mark.parametrize("octets", [b"\xc1", b"\x81", b"hello", b"\xff" * 4000])
def test_a_datagram_that_is_no_frame_is_dropped_with_a_line(gateway, shout, said, octets):
    shout(octets)
    assert gateway.receive() == []
    assert len(said) == 1
    assert "could not unpack" in said[0]


def test_frames_among_datagrams_that_are_none_arrive(gateway, shout):
    shout(b"\xc1")
    with open_bus(gateway.address, fd=False) as bus:
        send(bus, CanFrame(0x201, b"12345678"))
        shout(b"\xc1")
        assert gateway.receive() == [CanFrame(0x201, b"12345678")]
