"""Real sockets on free ports of the loopback interface."""

import socket
import struct

import numpy as np
import pytest

from drivers.protocol.rtde import Cutter, PackageType, encode
from drivers.protocol.rtde_setup import encode_names, encode_protocol_version
from drivers.protocol.rtde_states import RobotMode
from hil.cell.arm.connection import MAX_BACKLOG
from hil.cell.arm.server import DOORS, UrServer
from hil.cell.errors import DoorError
from hil.cell.rig import LatencyLaw
from hil.cell.rig.robot import Ports
from hil.cell.rig.task import Link

MS = 1_000_000
WAIT = 5.0  # wall seconds a test waits at most for loopback
FREE = Ports(**dict.fromkeys(DOORS, 0))
REGISTER = ("input_int_register_0",)


def doors(cell, ports=FREE, link=None):
    return UrServer(cell.arm, ports, "127.0.0.1", link or Link(), np.random.default_rng(3))


@pytest.fixture
def server(cell):
    with doors(cell) as server:
        yield server


@pytest.fixture
def knock(server):
    """A client's socket on one door, accepted."""
    sockets = []

    def knock(door):
        client = socket.create_connection(("127.0.0.1", server.ports[door]), WAIT)
        sockets.append(client)
        server.poll(0, WAIT)
        return client

    yield knock
    for client in sockets:
        client.close()


def ask(server, client, type, payload=b""):
    client.sendall(encode(type, payload))
    server.poll(0, WAIT)
    (package,) = Cutter().feed(client.recv(4096))
    return package.payload


def set_up(server, client, *, start=False):
    ask(server, client, PackageType.REQUEST_PROTOCOL_VERSION, encode_protocol_version(2))
    reply = ask(server, client, PackageType.SETUP_INPUTS, encode_names(REGISTER))
    ask(server, client, PackageType.SETUP_OUTPUTS, encode_names(("timestamp",), 125.0))
    if start:
        ask(server, client, PackageType.START)
    return reply


def test_every_door_has_a_port(server):
    assert set(server.ports) == set(DOORS)
    assert all(server.ports.values())


def test_the_dashboard_greets_and_answers(server, knock):
    client = knock("dashboard")
    assert client.recv(100) == b"Connected: Universal Robots Dashboard Server\n"
    client.sendall(b"robotmode\n")
    server.poll(0, WAIT)
    assert client.recv(100) == b"Robotmode: POWER_OFF\n"


def test_quit_closes_the_connection_after_the_reply(server, knock):
    client = knock("dashboard")
    client.recv(100)
    client.sendall(b"quit\n")
    server.poll(0, WAIT)
    assert client.recv(100) == b"Disconnected\n"
    assert client.recv(100) == b""
    assert server.clients == 0


def test_commands_count_valid_data_packages(server, knock):
    client = knock("rtde")
    set_up(server, client)
    client.sendall(encode(PackageType.DATA, b"\x01\0\0\0\x05") * 2)
    client.sendall(encode(PackageType.DATA, b"\x01\0"))
    server.poll(0, WAIT)
    assert server.take_commands() == 2
    assert server.take_commands() == 0


def test_packages_leave_when_due_and_in_one_piece(cell):
    link = Link(from_cell=LatencyLaw(law="constant", mean="3 ms"))
    with doors(cell, link=link) as server:
        client = socket.create_connection(("127.0.0.1", server.ports["rtde"]), WAIT)
        server.poll(0, WAIT)
        set_up(server, client, start=True)
        assert server.next_due is None
        server.publish(8 * MS, 1)
        server.publish(9 * MS, 2)
        assert server.next_due == 11 * MS
        server.flush(11 * MS - 1)
        client.setblocking(False)
        with pytest.raises(BlockingIOError):
            client.recv(1)
        server.flush(12 * MS)
        client.settimeout(WAIT)
        assert len(Cutter().feed(client.recv(4096))) == 2
        client.close()


def test_a_client_that_resets_releases_its_inputs(server, knock):
    first, second = knock("rtde"), knock("rtde")
    set_up(server, first)
    assert b"IN_USE" in set_up(server, second)
    first.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    first.close()  # RST, as a client that closes with unread data
    server.poll(0, WAIT)
    assert b"IN_USE" not in set_up(server, second)


def test_bytes_that_are_not_rtde_cut_the_client_off(cell, server, knock):
    client = knock("rtde")
    client.sendall(b"\0\0\0")
    server.poll(0, WAIT)
    assert client.recv(100) == b""
    assert "cut off" in cell.log


def test_a_client_that_does_not_read_is_cut_off_and_nobody_waits(cell, server, knock):
    client = knock("rtde")
    client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    set_up(server, client)
    names = ",".join(f"output_double_register_{n}" for n in range(24)).encode()
    ask(server, client, PackageType.SETUP_OUTPUTS, struct.pack(">d", 125.0) + names)
    ask(server, client, PackageType.START)
    for step in range(1, 100 * MAX_BACKLOG // 200):
        server.publish(step, step)
        server.flush(step)
        if server.clients == 0:
            break
    assert server.clients == 0
    assert "unread" in cell.log


def test_a_taken_port_is_named(cell, server):
    taken = Ports(**{**dict.fromkeys(DOORS, 0), "rtde": server.ports["rtde"]})
    with pytest.raises(DoorError, match=rf"rtde port 127.0.0.1:{taken.rtde}.*robot.ports.rtde"):
        doors(cell, taken).open()


def test_closed_doors_can_be_opened_again_at_once(cell):
    first = doors(cell)
    first.open()
    client = socket.create_connection(("127.0.0.1", first.ports["rtde"]), WAIT)
    first.poll(0, WAIT)
    ports = Ports(**first.ports)
    first.close()
    with doors(cell, ports) as second:
        assert second.ports == ports.model_dump()
    client.close()


@pytest.mark.parametrize("door", ["primary", "secondary", "realtime"])
def test_script_text_on_any_script_port_reaches_the_controller(server, knock, cell, door):
    knock(door).sendall(b"power on\n")
    server.poll(0, WAIT)
    assert cell.box.modes.robot is RobotMode.BOOTING


@pytest.mark.parametrize("door", ["secondary", "realtime"])
def test_a_client_that_only_sends_scripts_is_never_cut_off(cell, server, knock, door):
    client = knock(door)
    for step in range(1, 6000):
        server.publish(step * MS, step)
        server.flush(step * MS)
    client.sendall(b"power on\n")
    server.poll(0, WAIT)
    assert server.clients == 1
    assert cell.box.modes.robot is RobotMode.BOOTING


def test_streams_do_not_pace_the_lockstep(server, knock):
    knock("realtime")
    server.publish(8 * MS, 1)
    assert server.next_due is None
