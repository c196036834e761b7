"""A yardstick: the barest loop round the same plant, so that speeds compare between machines.

One process and two threads in lockstep: plain python-can frames, an RTDE-sized package each way
over TCP. There is no box, script, latency, noise, guard or recording in it.
"""

import socket
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Thread
from typing import Final

import can
import numpy as np

from drivers.protocol.nrs_can import COUNT_LIMIT, FORCE_LSB, TORQUE_LSB, Identifiers
from drivers.protocol.nrs_sample import decode_pair, encode_pair
from drivers.protocol.rtde import PackageType
from hil.cell.plant.ffc import FfcPlant
from hil.cell.plant.interface import Array, Plant, PlantStep, StageTarget
from hil.cell.rig import Rig
from hil.cell.sensor.shared_bus import message

IDENTIFIERS: Final = Identifiers.of(1)
LSB: Final = np.array([FORCE_LSB] * 3 + [TORQUE_LSB] * 3)
COMMAND: Final = struct.Struct(">HBB4d?Q")
STATE: Final = struct.Struct(">HBBd4d4d14dII6dii")
FILLER: Final = (0.0,) * 14 + (0, 0) + (0.0,) * 6 + (1, 2)
"""What else a recipe of twenty-odd variables carries: size, and time to pack it."""


@contextmanager
def ring(rig: Rig, rng: np.random.Generator) -> Iterator["Ring"]:
    """The cable's plant behind two loopback sockets and two virtual CAN buses."""
    channel = f"ring {id(rng)}"
    with (
        socket.create_server(("127.0.0.1", 0)) as door,
        socket.create_connection(door.getsockname()) as host,
        door.accept()[0] as cell,
        can.Bus(interface="virtual", channel=channel) as sent,
        can.Bus(interface="virtual", channel=channel) as received,
    ):
        for end in (host, cell):
            end.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        plant = FfcPlant(rig, rng)
        far = Thread(target=_serve, args=(plant, cell, sent), name="ring")
        far.start()
        try:
            yield Ring(plant, host, received)
        finally:
            host.shutdown(socket.SHUT_RDWR)
            far.join()


class Ring:
    """The near end, a plant to whoever uses it; a part's truth is not on these wires."""

    def __init__(self, plant: Plant, host: socket.socket, bus: can.BusABC) -> None:
        self._plant, self._host, self._bus = plant, host, bus
        self._rest: PlantStep | None = None

    def reset(self, stage: StageTarget) -> PlantStep:
        """As the plant's own; nothing is on its way then."""
        self._rest = self._plant.reset(stage)
        return self._rest

    def step(self, target: StageTarget, duration: int) -> PlantStep:
        """One period round the ring; the part is told as it was at reset."""
        assert self._rest is not None, "reset first"
        self._host.sendall(COMMAND.pack(COMMAND.size, PackageType.DATA, 1, *target, duration))
        wrenches = np.array([self._wrench() for _ in range(duration // 1_000_000)])
        state = STATE.unpack(_read(self._host, STATE.size))
        return PlantStep(wrenches, state[4:8], state[8:12], self._rest.part)

    def _wrench(self) -> tuple[float, ...]:
        force, torque = self._bus.recv(), self._bus.recv()
        assert force is not None
        assert torque is not None
        return decode_pair(bytes(force.data), bytes(torque.data)).wrench


def _serve(plant: Plant, cell: socket.socket, bus: can.BusABC) -> None:
    """The far end, until the near one hangs up."""
    count = 0
    while package := _read(cell, COMMAND.size):
        _, _, _, x, y, z, theta, closed, duration = COMMAND.unpack(package)
        step = plant.step(StageTarget(x, y, z, theta, closed), duration)
        for counts in _counts(step.wrenches):
            count += 1
            for frame in encode_pair(IDENTIFIERS, counts, 0, count):
                bus.send(message(frame))
        moved = (*step.stage, *step.velocity)
        cell.sendall(STATE.pack(STATE.size, PackageType.DATA, 1, count * 1e-3, *moved, *FILLER))


def _counts(wrenches: Array) -> list[list[int]]:
    counts: list[list[int]] = (
        np.rint(wrenches / LSB).clip(-COUNT_LIMIT, COUNT_LIMIT - 1).astype(np.int64).tolist()
    )
    return counts


def _read(end: socket.socket, size: int) -> bytes:
    """So many bytes, or none when the peer has hung up."""
    return end.recv(size, socket.MSG_WAITALL)
