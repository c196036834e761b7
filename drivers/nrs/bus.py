"""The driver's end of the CAN bus: python-can opened, drained, reopened, its errors made ours."""

import os
import socket
from contextlib import suppress
from queue import Queue
from typing import Final

import can
from can.interfaces.udp_multicast import UdpMulticastBus
from can.interfaces.udp_multicast.utils import unpack_message
from can.interfaces.virtual import VirtualBus

from drivers.errors import LinkError
from drivers.protocol.bus_address import BusAddress
from drivers.protocol.frame import CanFrame

RECEIVE_BUFFER: Final = 4_000_000
"""Bytes asked of the kernel: its default holds 278 unread frames and then drops silently."""
DATAGRAM: Final = 4096
"""Bytes of a udp_multicast datagram at most: python-can's own limit."""
_SO_RCVBUFFORCE: Final = 33
"""Linux, asm-generic/socket.h; beyond net.core.rmem_max, which is 212992 on most machines."""

CONFIGURED: Final = "config"
"""Interface name that leaves the choice to python-can's own configuration (~/.canrc, can.conf)."""
FIXED_RATE: Final = ("socketcan", "virtual", "udp_multicast", CONFIGURED)
"""Interfaces whose bit rate is not the program's to set: `ip link` or the configuration has it."""


def open_bus(
    address: BusAddress, fd: bool, bitrate: int | None = None, context: str | None = None
) -> can.BusABC:
    """Open a bus; LinkError names interface, channel and reason."""
    try:
        if address.interface == "socketcan":
            # python-can would open a socket first and leave it behind when there is no interface.
            socket.if_nametoindex(address.channel)
        bus = can.Bus(**options(address, fd, bitrate, context))  # type: ignore[arg-type]
    except Exception as error:  # python-can's back ends raise NameError, OSError and their own
        reason = " ".join(str(error).split()) or type(error).__name__
        raise LinkError(
            f"CAN {address.interface} '{address.channel}' cannot be opened: {reason}"
        ) from error
    _widen(bus)
    if isinstance(bus, UdpMulticastBus):
        os.set_blocking(bus.fileno(), False)
    return bus


def options(
    address: BusAddress, fd: bool, bitrate: int | None, context: str | None
) -> dict[str, object]:
    """Keyword arguments of `can.Bus`; what the address leaves open, the configuration fills in."""
    if address.interface == CONFIGURED:
        chosen: dict[str, object] = {"config_context": context or None}
        if address.channel:
            chosen["channel"] = address.channel
        return chosen
    chosen = dict(address.options())
    if fd and address.interface == "socketcan":
        chosen["fd"] = True
    if bitrate is not None and address.interface not in FIXED_RATE:
        chosen["bitrate"] = bitrate
    return chosen


def _widen(bus: can.BusABC) -> None:
    """Ask for a larger receive buffer where the bus is a socket; the kernel may grant less."""
    # A duplicate shares the socket and its options; closing it leaves the bus alone.
    with (
        suppress(NotImplementedError, OSError),
        socket.socket(fileno=os.dup(bus.fileno())) as duplicate,
    ):
        duplicate.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, RECEIVE_BUFFER)
        # Without CAP_NET_ADMIN an error, which leaves what was granted above.
        duplicate.setsockopt(socket.SOL_SOCKET, _SO_RCVBUFFORCE, RECEIVE_BUFFER)


def drain(bus: can.BusABC, into: list[can.Message]) -> None:
    """Append every message that the bus holds now, oldest first."""
    if isinstance(bus, VirtualBus) and not bus.filters:
        _drain_queue(bus.queue, into)
        return
    if isinstance(bus, UdpMulticastBus) and not bus.filters:
        _drain_datagrams(bus.fileno(), into)
        return
    while (message := bus.recv(0)) is not None:
        into.append(message)


def _drain_queue(inbox: "Queue[can.Message]", into: list[can.Message]) -> None:
    """All of the in-process bus at once: `recv` takes its lock and reads the clock each time."""
    with inbox.not_full:
        into.extend(inbox.queue)
        inbox.queue.clear()
        inbox.not_full.notify_all()


def _drain_datagrams(socket: int, into: list[can.Message]) -> None:
    """Datagram by datagram without `recv`'s select and time stamp: a third of its cost."""
    while True:
        try:
            datagram = os.read(socket, DATAGRAM)
        except BlockingIOError:
            return
        try:
            into.append(unpack_message(datagram, check=True))
        except Exception as error:  # whatever a stray datagram breaks, as python-can has it
            raise can.CanOperationError("could not unpack received message") from error


def send(bus: can.BusABC, frame: CanFrame) -> None:
    bus.send(
        can.Message(arbitration_id=frame.id, data=frame.data, is_extended_id=False, is_fd=frame.fd)
    )
