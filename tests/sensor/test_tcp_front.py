"""The sensor's TCP port as a client written from the public protocol meets it."""

import socket
import struct

import numpy as np
import pytest

from drivers.protocol.nrs_can import Identifiers
from drivers.protocol.nrs_command import Command, Opcode, encode_command
from drivers.protocol.nrs_sample import decode_pair
from hil.cell.errors import DoorError
from hil.cell.rig.latency import LatencyLaw
from hil.cell.rig.sensor import Sensor, SensorTcp
from hil.cell.rig.task import Link
from hil.cell.sensor.node import SensorNode
from hil.cell.sensor.tcp_connection import MAX_UNREAD
from hil.cell.sensor.tcp_port import CLIENTS, TcpPort

PERIOD = 8_000_000
LOAD = (1.5, -3.0, -9.81, 0.05, -0.1, 0.02)
IDS = Identifiers.of(1)


class Cell:
    """A node with its TCP port, a period at a time."""

    def __init__(self, laws=None, **choices):
        laws = laws or Link()
        tcp = SensorTcp(enabled=True, port=0)
        sensor = Sensor(preset="nrs-6050-d80-quiet", tcp=tcp, boot_time="0 s", **choices)
        self.said = []
        self.node = SensorNode(sensor, np.random.default_rng(7))
        self.port = TcpPort(
            self.node,
            sensor,
            host="127.0.0.1",
            laws=laws,
            rng=np.random.default_rng(1),
            say=self.said.append,
        )
        self.t = 0
        self.frames = []

    def step(self, periods=1, load=LOAD):
        for _ in range(periods):
            self.port.take(self.t, self.t + PERIOD)
            self.t += PERIOD
            self.frames += self.node.advance(self.t, np.tile(load, (8, 1)))
            self.port.publish(self.t)
            self.port.flush(self.t)


class Client:
    """Ten lines of a vendor-style client: length, type, payload; big-endian doubles."""

    def __init__(self, cell):
        self.cell = cell
        self.link = socket.create_connection(cell.port.address)
        self.link.settimeout(0)

    def ask(self, *octets):
        self.link.sendall(bytes((3, *octets)))
        self.cell.step(2)
        return self.messages()

    def messages(self):
        found, stream = [], b""
        try:
            while chunk := self.link.recv(65536):
                stream += chunk
        except BlockingIOError:
            pass
        while stream:
            found.append(stream[: stream[0]])
            stream = stream[stream[0] :]
        return found

    def wrenches(self):
        return [struct.unpack("!6d", m[2:]) for m in self.messages() if m[:2] == b"\x32\x06"]


@pytest.fixture
def cell():
    cell = Cell()
    cell.step()
    yield cell
    cell.port.close()


@pytest.fixture
def client(cell):
    client = Client(cell)
    yield client
    client.link.close()


def test_nothing_comes_before_a_start(cell, client):
    cell.step(20)
    assert client.messages() == []


def test_start_is_answered_and_eight_samples_come_in_eight_milliseconds(cell, client):
    first, *_ = client.ask(0x07, 1)
    assert first == bytes((3, 0x07, 0))
    client.messages()
    cell.step(10)
    assert len(client.wrenches()) == pytest.approx(80, abs=1)


def test_stop_is_answered_and_ends_the_stream(cell, client):
    client.ask(0x07, 1)
    assert bytes((3, 0x07, 0)) in client.ask(0x07, 0)
    cell.step(5)
    assert client.messages() == []


def test_samples_are_newtons_of_whole_counts(cell, client):
    client.ask(0x07, 1)
    cell.step()
    assert client.wrenches()[-1] == pytest.approx(LOAD, abs=0.0076)


@pytest.mark.parametrize(("ms", "samples"), [(1, 400), (5, 80), (200, 2)])
def test_the_rate_is_the_one_asked_for(cell, client, ms, samples):
    assert client.ask(0x08, ms) == [bytes((3, 0x08, 0))]
    client.ask(0x07, 1)
    client.messages()
    cell.step(50)
    assert len(client.wrenches()) == pytest.approx(samples, abs=1)


@pytest.mark.parametrize("octets", [(0x08, 0), (0x08, 201), (0x07, 2), (0x15, 9), (0x99, 1)])
def test_what_cannot_be_is_refused_and_changes_nothing(cell, client, octets):
    assert client.ask(*octets) == [bytes((3, octets[0], 1))]
    client.ask(0x07, 1)
    client.messages()
    cell.step(10)
    assert len(client.wrenches()) == pytest.approx(80, abs=1)


def test_a_tare_before_the_start_is_answered_when_it_is_done(cell, client):
    assert client.ask(0x15, 1) == []
    cell.step(8)
    assert client.messages() == [bytes((3, 0x15, 0))]
    client.ask(0x07, 1)
    cell.step()
    assert client.wrenches()[-1] == (0.0,) * 6


def test_before_the_tares_answer_samples_are_loaded_and_after_it_zero(cell, client):
    client.ask(0x07, 1)
    client.messages()
    client.link.sendall(bytes((3, 0x15, 1)))
    cell.step(12)
    stream = client.messages()
    cut = stream.index(bytes((3, 0x15, 0)))
    fz = [struct.unpack("!6d", m[2:])[2] for m in stream if m[1] == 0x06]
    assert fz[:cut] == pytest.approx([-9.81] * cut, abs=0.0076)
    assert fz[cut:] == [0.0] * (len(fz) - cut)
    assert len(fz) > cut > 40


def test_a_cleared_tare_brings_the_load_back(cell, client):
    client.ask(0x15, 1)
    cell.step(8)
    assert client.ask(0x15, 0)[-1] == bytes((3, 0x15, 0))
    client.ask(0x07, 1)
    cell.step()
    assert client.wrenches()[-1] == pytest.approx(LOAD, abs=0.0076)


def test_can_and_tcp_carry_the_same_samples_on_the_same_zero(cell, client):
    cell.node.receive(encode_command(IDS, Command(Opcode.TRANSMIT, 1, (1,))), cell.t)
    client.ask(0x07, 1)
    client.ask(0x15, 1)
    cell.step(10)
    client.messages()
    cell.step()
    cell.frames.clear()
    client.messages()
    cell.step(20, load=(2.0, 1.0, -30.0, 0.1, 0.2, -0.3))
    forces = [frame.data for _, frame in cell.frames if frame.id == IDS.force]
    torques = [frame.data for _, frame in cell.frames if frame.id == IDS.torque]
    # A torque frame may be on its way from the period before, or into the next.
    by_counter = {data[7]: data for data in torques}
    can = [decode_pair(f, by_counter[f[7]]).wrench for f in forces if f[7] in by_counter]
    tcp = client.wrenches()
    assert len(can) > 100
    assert tcp[: len(can)] == [pytest.approx(wrench, abs=1e-9) for wrench in can]


def test_a_client_that_leaves_in_a_tare_does_not_keep_others_from_theirs(cell, client):
    client.ask(0x15, 1)
    client.link.close()
    cell.step()
    other = Client(cell)
    other.ask(0x15, 1)
    cell.step(8)
    assert other.messages() == [bytes((3, 0x15, 0))]
    other.link.close()


def test_while_one_client_tares_another_is_refused(cell, client):
    client.ask(0x15, 1)
    other = Client(cell)
    assert other.ask(0x15, 1) == [bytes((3, 0x15, 1))]
    other.link.close()


def test_a_restart_of_the_sensor_cuts_every_client_off(cell, client):
    client.ask(0x07, 1)
    client.messages()
    cell.node.reboot(cell.t)
    cell.step(2)
    assert client.link.recv(65536) == b""


def test_bytes_that_are_not_the_protocol_end_the_connection_and_no_other(cell, client):
    other = Client(cell)
    other.link.sendall(b"\x00garbage")
    cell.step()
    assert other.link.recv(10) == b""
    assert cell.said == ["sensor TCP: cut off: NRS message of length 0, the least is 2"]
    assert client.ask(0x08, 1) == [bytes((3, 0x08, 0))]
    other.link.close()


def test_a_client_that_never_reads_is_cut_off():
    cell = Cell()
    link = socket.socket()
    link.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    link.connect(cell.port.address)
    link.sendall(bytes((3, 0x07, 1)))
    for _ in range(40_000):
        if cell.said:
            break
        cell.step()
    assert f"allowed are {MAX_UNREAD}" in cell.said[0]
    link.close()
    cell.port.close()


def test_more_clients_than_there_is_room_for_are_turned_away(cell):
    links = [Client(cell).link for _ in range(CLIENTS + 1)]
    cell.step()
    assert links[-1].recv(1) == b""
    assert f"turned away, {CLIENTS} clients" in cell.said[0]
    for link in links:
        link.close()


def test_a_message_takes_the_time_that_the_rig_says():
    delay = LatencyLaw(mean="20 ms")
    cell = Cell(Link(to_cell=delay, from_cell=delay))
    cell.step()
    client = Client(cell)
    client.link.sendall(bytes((3, 0x08, 1)))
    cell.step(5)  # taken at 8 ms, at the node at 28 ms, back at 48.2 ms
    assert client.messages() == []
    cell.step(1)
    assert client.messages() == [bytes((3, 0x08, 0))]
    client.link.close()
    cell.port.close()


def test_a_port_in_use_is_named_with_the_way_out():
    with socket.create_server(("127.0.0.1", 0)) as taken:
        sensor = Sensor(tcp=SensorTcp(port=taken.getsockname()[1]))
        node = SensorNode(sensor, np.random.default_rng(0))
        rng = np.random.default_rng(0)
        with pytest.raises(DoorError, match=r"set sensor\.tcp\.port to 0"):
            TcpPort(node, sensor, host="127.0.0.1", laws=Link(), rng=rng, say=print)
