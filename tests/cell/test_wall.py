"""A cell that the wall clock paces, with a clock that the test moves: who disturbs whom."""

import os
import socket
from contextlib import ExitStack, suppress

import numpy as np
import pytest

from drivers.protocol.rtde import Cutter, PackageType, encode
from drivers.protocol.rtde_setup import encode_names, encode_protocol_version
from hil.cell.arm.server import DOORS
from hil.cell.assemble import serve
from hil.cell.clock import Schedule
from hil.cell.rig import parse

CB3 = "series: cb3"
E_SERIES = "series: e-series, model: ur5e, version: 5.11.0.108249"
LIMIT = 5.0  # wall seconds that loopback may take
RIG = """
name: wall
physics: {{plant: wall}}
can: {{interface: udp_multicast}}
robot: {{{robot}, ports: {{dashboard: 0, primary: 0, secondary: 0, realtime: 0, rtde: 0}}}}
"""


class HandClock:
    """Each look at it costs a third of a period; nobody sleeps."""

    def __init__(self, period):
        self.t, self._step = 0, period // 3

    def __call__(self):
        self.t += self._step
        return self.t


class HandSchedule(Schedule):
    def nap(self, duration):
        pass


class Client:
    """An RTDE client that receives every period and keeps what came."""

    def __init__(self, address):
        self.link = socket.create_connection(address, LIMIT)
        self._cutter = Cutter()
        self.link.sendall(
            encode(PackageType.REQUEST_PROTOCOL_VERSION, encode_protocol_version(2))
            + encode(PackageType.SETUP_OUTPUTS, encode_names(("timestamp",), 500.0))
            + encode(PackageType.START)
        )

    def packages(self):
        octets = b""
        self.link.setblocking(False)
        with suppress(BlockingIOError):
            while got := self.link.recv(1 << 16):
                octets += got
        return [p for p in self._cutter.feed(octets) if p.type == PackageType.DATA]


@pytest.fixture(params=[CB3, E_SERIES], ids=["cb3", "e-series"])
def cell(request):
    with serve(parse(RIG.format(robot=request.param)), 1, across_processes=True) as cell:
        yield cell


@pytest.fixture
def address(cell):
    return lambda door: ("127.0.0.1", cell.server.ports[door])


def keep(cell, periods, observe=lambda tick: None):
    """Run so many periods; the schedule's statistics."""
    schedule = HandSchedule(cell.bench.period, HandClock(cell.bench.period))
    end = cell.bench.t + periods * cell.bench.period
    cell.wall(lambda: cell.bench.t >= end, observe, schedule)
    return schedule.lateness()


def test_clients_come_and_go_and_the_cell_goes_on(cell, address):
    with ExitStack() as stack:
        for n in range(24):
            door = DOORS[n % len(DOORS)]
            link = socket.create_connection(address(door), LIMIT)
            if n % 2:
                stack.enter_context(link)
            assert keep(cell, 5).periods == 5
            link.close()
    assert keep(cell, 5).missed == 0
    assert set(cell.traffic().clients.values()) == {0}


def test_a_client_among_seven_bad_ones_gets_every_package(cell, address):
    client, noise = Client(address("rtde")), np.random.default_rng(7)
    with ExitStack() as stack:
        stack.enter_context(client.link)
        doors = (*DOORS, "rtde", "rtde")
        bad = [stack.enter_context(socket.create_connection(address(d), LIMIT)) for d in doors]
        for link in bad:
            link.setblocking(False)

        def disturb(_tick):
            for link in bad:
                with suppress(OSError):
                    link.send(noise.bytes(1 << 12))

        keep(cell, 3)
        client.packages()
        keep(cell, 100, disturb)
        assert len(client.packages()) == 100
    events = cell.traffic().events
    assert events["cut off"] >= 3


def test_a_client_that_never_reads_costs_the_others_nothing(cell, address):
    client, lazy = Client(address("rtde")), Client(address("rtde"))
    with client.link, lazy.link:
        keep(cell, 3)
        client.packages()
        assert keep(cell, 100).periods == 100
        assert len(client.packages()) == 100
    assert cell.traffic().clients["rtde"] == 2


def test_a_closed_cell_holds_no_descriptor():
    before = len(os.listdir("/proc/self/fd"))
    with serve(parse(RIG.format(robot=CB3)), 1, across_processes=True) as cell:
        link = socket.create_connection(("127.0.0.1", cell.server.ports["rtde"]), LIMIT)
        keep(cell, 3)
        link.close()
    assert len(os.listdir("/proc/self/fd")) == before
