"""The cell's end of the CAN bus; the only file of the far side that knows python-can."""

from collections.abc import Callable, Iterator
from typing import Final, TypeAlias
from uuid import uuid4

import can

from drivers.protocol.bus_address import BusAddress
from drivers.protocol.frame import CanFrame
from hil.cell.errors import DoorError
from hil.cell.rig.sensor import CanBus
from hil.cell.sensor.can_interfaces import free_udp_port, up_can_interfaces
from hil.cell.sensor.multicast_bus import BatchMulticastBus
from hil.cell.sensor.shared_bus import SharedVirtualBus, message

Say: TypeAlias = Callable[[str], None]

MOST: Final = 256
"""Frames taken in one call: what a bus of 1 Mbit/s carries in 12 ms; further ones wait."""


def unheard(_: str) -> None:
    """Say nothing."""


class Gateway:
    """Sends and takes frames without waiting. say: told in one line what was dropped."""

    def __init__(self, bus: can.BusABC, address: BusAddress, say: Say = unheard) -> None:
        self._bus = bus
        self._address = address
        self._say = say
        self._sent: set[int] = set()

    @property
    def address(self) -> BusAddress:
        """Where a driver finds the other end."""
        return self._address

    def describe(self) -> str:
        return f"CAN: {self._address.interface} {self._address.channel}"

    def send(self, frames: list[CanFrame]) -> None:
        """Put frames on the bus in order; raises DoorError."""
        self._sent.update([frame.id for frame in frames])
        try:
            if isinstance(self._bus, SharedVirtualBus | BatchMulticastBus):
                self._bus.send_frames(frames)
            else:
                for frame in frames:
                    self._bus.send(message(frame))
        except (can.CanError, OSError) as error:
            raise DoorError(f"{self.describe()}: cannot send: {error}") from error

    def receive(self) -> list[CanFrame]:
        """Standard data frames that others sent since the last call; raises DoorError."""
        bus = self._bus
        messages = bus.take_all() if isinstance(bus, SharedVirtualBus) else self._received()
        return [
            CanFrame(message.arbitration_id, bytes(message.data), message.is_fd)
            for message in messages
            # udp_multicast hears its own frames; nobody else owns these identifiers.
            if _is_data(message) and message.arbitration_id not in self._sent
        ]

    def _received(self) -> Iterator[can.Message]:
        for _ in range(MOST):
            try:
                message = self._bus.recv(0)
            except (can.CanError, OSError) as error:
                if not _is_garbage(error):
                    raise DoorError(f"{self.describe()}: cannot receive: {error}") from error
                self._say(f"{self.describe()}: {error}")
                continue
            if message is None:
                return
            yield message

    def close(self) -> None:
        self._bus.shutdown()


def open_gateway(
    can_bus: CanBus, across_processes: bool, fd: bool = False, say: Say = unheard
) -> Gateway:
    """The bus that the rig asks for; DoorError says in one line why it cannot be had."""
    address = choose(can_bus, across_processes, up_can_interfaces())
    try:
        bus = _open(address, fd)
    except Exception as error:  # python-can's back ends raise NameError, OSError and their own
        reason = " ".join(str(error).split()) or type(error).__name__
        raise DoorError(
            f"can: cannot open {address.interface} '{address.channel}': {reason}"
        ) from error
    return Gateway(bus, address, say)


def _open(address: BusAddress, fd: bool) -> can.BusABC:
    if address.interface == "virtual":
        return SharedVirtualBus(address.channel)
    if address.interface == "udp_multicast":
        return BatchMulticastBus(*address.group)
    options: dict[str, object] = dict(address.options())
    if fd and address.interface == "socketcan":
        options["fd"] = True
    return can.Bus(**options)  # type: ignore[arg-type]


def choose(can_bus: CanBus, across_processes: bool, kernel: list[str]) -> BusAddress:
    """The address for a rig's bus section; kernel lists the CAN interfaces that are up."""
    interface: str = can_bus.interface
    if interface == "auto":
        local = "udp_multicast" if across_processes else "virtual"
        interface = "socketcan" if can_bus.channel in kernel or kernel else local
    channel = can_bus.channel
    if interface == "virtual" and across_processes:
        raise DoorError("can: interface 'virtual' ends at the process; use 'udp_multicast'")
    if interface == "socketcan" and not channel:
        if not kernel:
            raise DoorError("can: no kernel CAN interface is up (ip link add dev vcan0 type vcan)")
        channel = kernel[0]
    return BusAddress(interface, channel or _unique_channel(interface))


def _unique_channel(interface: str) -> str:
    """A channel of this run's own: two testbeds on one host must not hear each other."""
    if interface == "virtual":
        # Not digits last: python-can takes those for a channel number, and BLF has 16 bits for it.
        return f"hil-{uuid4().hex[:8]}-bus"
    port = free_udp_port()
    return f"239.74.{port >> 8}.{port & 0xFF}:{port}"


def _is_data(message: can.Message) -> bool:
    return not (message.is_extended_id or message.is_remote_frame or message.is_error_frame)


def _is_garbage(error: Exception) -> bool:
    """Whether a datagram was no CAN frame: anybody can send those to a udp_multicast group."""
    cause = error.__cause__
    return cause is not None and not isinstance(cause, OSError)
