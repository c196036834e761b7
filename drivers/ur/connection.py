"""The RTDE connection: one TCP stream, one recipe each way."""

import socket
from collections import deque
from collections.abc import Sequence
from typing import Final

from drivers.errors import LinkError, ProtocolError
from drivers.protocol import rtde_setup as setup
from drivers.protocol.errors import WireError
from drivers.protocol.rtde import Cutter, Package, PackageType, encode
from drivers.ur.rtde_client import Agreement, Dialogue, handshake
from drivers.ur.tcp import explain, open_stream

_BUFFER: Final = 1 << 16
"""Some 250 packages: a receive that does not fill it has emptied the socket."""


class RtdeConnection:
    """RTDE to one controller. Wall-clock `limit`, s, guards against a silent peer only."""

    def __init__(
        self, host: str, port: int, outputs: Sequence[str], inputs: Sequence[str], limit: float
    ) -> None:
        self._peer = f"RTDE at {host}:{port}"
        self._address = (host, port)
        self._names = (tuple(outputs), tuple(inputs))
        self._limit = limit
        self._stream: socket.socket | None = None
        self._agreement: Agreement | None = None
        self._cutter = Cutter()
        self._buffer = memoryview(bytearray(_BUFFER))
        self.received: list[bytes] = []  # payloads of the last data packages
        self.texts: deque[setup.TextMessage] = deque(maxlen=8)  # newest last, for error messages

    @property
    def is_open(self) -> bool:
        return self._agreement is not None

    def open(self) -> Agreement:
        """Connect and agree on the recipes; data flows from here on."""
        self.close()
        self._cutter = Cutter()
        self._stream = open_stream(*self._address, "RTDE", self._limit)
        try:
            self._agreement = self._negotiate(handshake(*self._names))
        except BaseException:
            self.close()
            raise
        return self._agreement

    def close(self) -> None:
        """Drop the connection; never raises."""
        if self._stream is not None:
            self._stream.close()
        self._stream = self._agreement = None

    def pack(self, values: Sequence[object]) -> bytes:
        """One package of the input recipe."""
        agreement = self._agreed()
        body = agreement.inputs.pack(values)
        return encode(PackageType.DATA, bytes((agreement.input_id,)) + body)

    def read(self) -> list[tuple[object, ...]]:
        """Block for packages of the output recipe; the values of all that wait, in their order.

        Their payloads are in `received`.
        """
        agreement = self._agreed()
        self.received = []
        full = False
        while not self.received or full:
            packages, full = self._receive()
            for package in packages:
                if package.type == PackageType.DATA:
                    self.received.append(package.payload)
                else:
                    self._note(package)
        return [self._unpack(agreement, payload) for payload in self.received]

    def read_newest(self) -> tuple[object, ...]:
        """Block for a package of the output recipe; the last one's values."""
        return self.read()[-1]

    def _unpack(self, agreement: Agreement, payload: bytes) -> tuple[object, ...]:
        if not payload or payload[0] != agreement.output_id:
            raise self._broken("data of a recipe that was not agreed")
        try:
            return agreement.outputs.unpack(payload[1:])
        except WireError as error:
            raise self._broken(error) from error

    def _agreed(self) -> Agreement:
        if self._agreement is None:
            raise LinkError(f"{self._peer} is not connected; call connect()")
        return self._agreement

    def _connected(self) -> socket.socket:
        if self._stream is None:
            raise LinkError(f"{self._peer} is not connected; call connect()")
        return self._stream

    def put(self, package: bytes) -> None:
        """Send bytes that are a whole package."""
        stream = self._connected()
        try:
            stream.sendall(package)
        except OSError as error:
            self.close()
            raise explain(error, self._peer, self._limit) from error

    def _receive(self) -> tuple[list[Package], bool]:
        """The packages one receive completes, and whether it filled the buffer."""
        stream = self._connected()
        try:
            count = stream.recv_into(self._buffer)
        except OSError as error:
            self.close()
            raise explain(error, self._peer, self._limit) from error
        if not count:
            self.close()
            raise LinkError(f"{self._peer} closed the connection")
        try:
            return self._cutter.feed(bytes(self._buffer[:count])), count == _BUFFER
        except WireError as error:
            raise self._broken(error) from error

    def _broken(self, fault: object) -> ProtocolError:
        """A stream that broke the protocol once cannot be trusted again."""
        self.close()
        return ProtocolError(f"{self._peer}: {fault}")

    def _negotiate(self, dialogue: Dialogue) -> Agreement:
        """Carry a dialogue over the stream to its end."""
        pending: deque[Package] = deque()
        try:
            request = next(dialogue)
            while True:
                self.put(request)
                while not pending:
                    pending.extend(self._receive()[0])
                request = dialogue.send(pending.popleft())
        except StopIteration as end:
            agreement: Agreement = end.value
            return agreement
        except WireError as error:
            raise self._broken(error) from error

    def _note(self, package: Package) -> None:
        """Keep what the controller wants a person to read; other packages mean nothing now."""
        if package.type != PackageType.TEXT_MESSAGE:
            return
        try:
            self.texts.append(setup.decode_text(package.payload))
        except WireError as error:
            raise self._broken(error) from error
