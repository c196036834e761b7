"""The sensor's driver over a real TCP connection: links that fail, and the whole loop on it."""

import socket

import pytest

from controller.outcome import Kind
from drivers.errors import LinkError, ProtocolError
from drivers.nrs.tcp_sensor import TcpSensor
from hil.app.run import Request, run
from hil_fixtures.testbed import open_testbed, shipped


@pytest.fixture
def server():
    with socket.create_server(("127.0.0.1", 0)) as server:
        yield server


@pytest.fixture
def peer(server):
    """A connected driver and the other end of its wire."""
    sensor = TcpSensor(*server.getsockname())
    sensor.connect()
    client, _ = server.accept()
    yield sensor, client
    client.close()
    sensor.close()


def test_a_refused_connection_names_the_address(server):
    host, port = server.getsockname()
    server.close()
    with pytest.raises(LinkError, match=f"{host}:{port} refused"):
        TcpSensor(host, port).connect()


def test_a_driver_that_is_not_connected_says_so():
    with pytest.raises(LinkError, match="connect"):
        TcpSensor("127.0.0.1").poll(0)


def test_a_cut_link_is_an_error_that_says_what_it_means_for_the_tare(peer):
    sensor, client = peer
    client.close()
    with pytest.raises(LinkError, match="tare is gone"):
        sensor.poll(0)
    assert not sensor.health.receiver_alive


def test_a_peer_that_speaks_something_else_is_hung_up_on(peer):
    sensor, client = peer
    client.sendall(b"\x00\x00HTTP")
    with pytest.raises(ProtocolError, match="length 0"):
        sensor.poll(0)
    assert client.recv(1) == b""


@pytest.fixture
def rig():
    rig = shipped("ffc_ur5")
    return rig.model_copy(update={"sensor": rig.sensor.model_copy(update={"wire": "tcp"})})


def test_a_run_over_tcp_inserts_and_repeats_to_the_byte(rig, tmp_path):
    results = [
        run(Request(rig, b"rig", 1, "FFC1", layout=layout, out=tmp_path / layout), ignore)
        for layout in ("inline", "process")
    ]
    assert {result.outcome.kind for result in results} == {Kind.INSERTED}
    assert len({result.digest for result in results}) == 1


def ignore(_cycle, _course, _cell):
    """Watches nothing."""


def test_a_sensor_that_restarts_in_a_run_ends_its_link(rig):
    with open_testbed(rig) as bed:
        arm, sensor = bed.near.arm, bed.near.sensor
        arm.connect()
        sensor.connect()
        sensor.start()
        while not sensor.ready:
            sensor.poll(arm.read().t)
            arm.hold()
        bed.cell.served.bench.node.reboot(arm.read().t)
        for _ in range(2):  # the period in which it restarts, and the one that shows it
            arm.hold()
            t = arm.read().t
        sensor.poll(t)  # what it had sent before
        with pytest.raises(LinkError):
            sensor.poll(t)
