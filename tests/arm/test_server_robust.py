"""Clients that err, flood, sleep or lie: the box drops or throttles them and serves the others."""

import socket
from contextlib import ExitStack, suppress

import numpy as np
import pytest

from drivers.protocol.rtde import Cutter, PackageType, encode
from drivers.protocol.rtde_setup import encode_names
from hil.cell.arm.connection import MAX_BACKLOG
from hil.cell.arm.programs import MAX_SECONDARY
from hil.cell.arm.script_session import MAX_REFUSED
from hil.cell.arm.server import CLIENTS, DOORS, ROUNDS, UrServer
from hil.cell.rig.robot import Ports
from hil.cell.rig.task import Link

WAIT = 5.0  # wall seconds a test waits at most for loopback
FREE = Ports(**dict.fromkeys(DOORS, 0))
VERSION = encode(PackageType.GET_CONTROLLER_VERSION)


class Cell:
    """An arm behind open doors, and clients that the test closes with it."""

    def __init__(self, arm, stack):
        self.arm = arm
        self.server = stack.enter_context(
            UrServer(arm, FREE, "127.0.0.1", Link(), np.random.default_rng(3))
        )
        self._stack = stack
        self.step = 0

    def knock(self, door):
        client = self._stack.enter_context(
            socket.create_connection(("127.0.0.1", self.server.ports[door]), WAIT)
        )
        self.server.poll(0, WAIT)
        return client

    def period(self):
        """What a cell that a clock paces does with its doors in a control period."""
        self.step += 1
        self.server.ration()
        self.server.poll(self.step, 0.0)
        self.server.publish(self.step, self.step)
        self.server.flush(self.step)

    def answers(self, client, request=VERSION, replies=1):
        """Whether the box answers an RTDE client that asks now."""
        client.sendall(request)
        cutter, found = Cutter(), []
        while len(found) < replies:
            self.period()
            client.setblocking(False)
            try:
                got = client.recv(1 << 16)
            except BlockingIOError:
                continue
            if not got:
                return False
            found += cutter.feed(got)
        return True

    @property
    def counts(self):
        return self.arm.box.doors.counts

    @property
    def log(self):
        return [text for _, text in self.arm.log]


@pytest.fixture
def served(running):
    with ExitStack() as stack:
        yield Cell(running.arm, stack)


def gone(client):
    client.settimeout(WAIT)
    try:
        while client.recv(1 << 16):
            pass
    except ConnectionResetError:
        pass
    return True


def test_one_client_more_than_there_is_room_for_is_turned_away(served):
    clients = [served.knock("rtde") for _ in range(CLIENTS + 1)]
    assert gone(clients[-1])
    assert served.server.visitors["rtde"] == CLIENTS
    assert served.counts == {"turned away": 1}
    assert served.answers(clients[0])


def test_a_full_port_has_room_again_when_a_client_leaves(served):
    clients = [served.knock("dashboard") for _ in range(CLIENTS)]
    clients[0].close()
    served.server.poll(0, WAIT)
    served.knock("dashboard").sendall(b"quit\n")
    assert served.server.visitors["dashboard"] == CLIENTS
    assert "turned away" not in served.counts


def test_a_flood_of_connections_ends_no_period_and_leaves_nothing_behind(served):
    client = served.knock("rtde")
    for _ in range(40):
        with ExitStack() as flood:
            for _ in range(ROUNDS):
                address = ("127.0.0.1", served.server.ports["primary"])
                flood.enter_context(socket.create_connection(address, WAIT))
            served.period()
    for _ in range(3):
        served.period()
    assert served.answers(client)
    assert served.server.clients == 1
    assert sum(served.counts.values()) == 40 * ROUNDS
    assert len(served.log) < 30


@pytest.mark.parametrize("door", DOORS)
def test_noise_on_a_port_disturbs_no_client_of_another(served, door):
    client, noisy = served.knock("rtde"), served.knock(door)
    noise = np.random.default_rng(5)
    noisy.setblocking(False)
    for _ in range(60):
        with suppress(OSError):  # cut off, or held back
            noisy.send(noise.bytes(1 << 14))
        served.period()
    assert served.answers(client)
    assert len(served.log) < 2000


def test_text_that_is_no_urscript_gets_its_sender_cut_off(served):
    client = served.knock("secondary")
    client.sendall(b"GET / HTTP/1.1\r\n" * (MAX_REFUSED + 1))
    served.server.poll(0, WAIT)
    assert gone(client)
    assert served.counts == {"cut off": 1}


def test_a_flood_of_packages_is_handled_a_share_a_period(served):
    polite, flooding = served.knock("rtde"), served.knock("rtde")
    flooding.sendall(VERSION * 4000)
    share = 2048 // len(VERSION)
    served.period()
    got = Cutter().feed(flooding.recv(1 << 20))
    assert len(got) == share
    assert served.answers(polite)
    assert served.counts["periods over the share"] >= 1


def test_what_waits_for_its_share_is_handled_in_the_end(served):
    client = served.knock("rtde")
    assert served.answers(client, VERSION * 4000, replies=4000)
    assert "lost" not in served.counts
    assert served.server.clients == 1


def test_a_client_that_leaves_while_it_waits_for_its_share_is_let_go(served):
    client = served.knock("rtde")
    client.sendall(VERSION * 4000)
    served.period()
    client.close()
    for _ in range(20):
        served.period()
    assert served.server.clients == 0


def test_a_client_that_asks_and_never_reads_is_cut_off(served):
    client = served.knock("dashboard")
    client.setblocking(False)
    questions = b"programState\n" * 4000
    for _ in range(1000 * MAX_BACKLOG // len(questions)):
        with suppress(OSError):  # cut off, or held back
            client.send(questions)
        served.period()
        if served.server.clients == 0:
            break
    assert served.counts["cut off"] == 1


def test_a_package_that_comes_a_byte_a_period_is_understood(served):
    client = served.knock("rtde")
    request = encode(PackageType.SETUP_INPUTS, encode_names(("input_int_register_0",)))
    for byte in request[:-1]:
        client.sendall(bytes((byte,)))
        served.period()
    assert served.answers(client, request[-1:])


@pytest.mark.parametrize(
    ("door", "endless"),
    [
        ("rtde", b"\xff\xff\x55" + b"x" * 5000),
        ("dashboard", b"robotmode" * 1000),
        ("primary", b"def p():\n" + b" x = 1\n" * (1 << 18)),
    ],
)
def test_what_never_ends_is_cut_off_at_a_bound(served, door, endless):
    client = served.knock(door)
    client.setblocking(False)
    while served.server.clients:
        try:
            endless = endless[client.send(endless) :]
        except BlockingIOError:
            pass
        except OSError:
            endless = b""
        served.period()
    assert served.counts["cut off"] == 1


def test_a_half_open_peer_is_asked_for_a_sign_of_life(served):
    served.knock("rtde")
    (connection,) = served.server._connections
    assert connection.socket.getsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE)


def test_a_client_that_shuts_its_sending_side_gets_its_answer_first(served):
    client = served.knock("dashboard")
    client.sendall(b"robotmode\n")
    client.shutdown(socket.SHUT_WR)
    served.period()
    served.period()
    client.settimeout(WAIT)
    assert b"Robotmode: RUNNING\n" in client.recv(1000)
    assert served.server.clients == 0


def test_secondary_programs_without_end_stay_few(served):
    client = served.knock("secondary")
    for n in range(MAX_SECONDARY + 1):
        client.sendall(f"sec p{n}():\n while True:\n  sync()\n end\nend\n".encode())
        served.server.poll(0, WAIT)
    assert f"program p{MAX_SECONDARY} refused: {MAX_SECONDARY} secondary" in served.log[-1]
