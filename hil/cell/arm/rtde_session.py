"""One RTDE client's session on the controller's side: bytes in, reply bytes out, no sockets.

Follows the RTDE guide; what the guide leaves open is decided as UR's own and third-party clients
need it, and said at the line.
"""

from collections.abc import Callable, Iterator
from math import floor, isfinite
from typing import Final

from drivers.protocol.errors import WireError
from drivers.protocol.rtde import (
    IN_USE,
    MAX_PACKAGE,
    NOT_FOUND,
    Cutter,
    Package,
    PackageType,
    Recipe,
    encode,
)
from drivers.protocol.rtde_setup import (
    ControllerVersion,
    TextLevel,
    TextMessage,
    decode_names,
    decode_names_with_frequency,
    decode_protocol_version,
    encode_accepted,
    encode_controller_version,
    encode_text,
    encode_types,
)
from drivers.protocol.rtde_variables import INPUTS, OUTPUTS
from hil.cell.arm.controller import ArmController
from hil.cell.arm.door_log import Event
from hil.cell.arm.variables import Reader, readers

MAX_INPUT_RECIPES: Final = 255
MAX_DATA: Final = 2000
"""UR's clients drop larger data packages, so an output recipe above this is refused."""

MAX_REPLY: Final = MAX_PACKAGE - 3
"""A request of many short names asks for more types than a package holds."""

SLOWEST: Final = 1e-3
"""Hz; the guide says 1 Hz, slower ones do no harm."""

OUTPUT_RECIPE: Final = 1

SHARE: Final = 1 << 11
"""Every input of the robot at once fits twice; empty packages, 5 us each, cost 3 ms at most."""


class RtdeSession:
    """commands: valid data packages received so far. closing: never, RTDE has no farewell."""

    greeting = b""
    closing = False
    lossy = False
    share = SHARE

    def __init__(self, arm: ArmController, client: int, delays: Iterator[int]) -> None:
        """client: its number in `Ownership`. delays: travel times of its data packages, ns."""
        self.commands = 0
        self._arm = arm
        self._box = arm.box
        self._client = client
        self._delays = delays
        self._cutter = Cutter()
        self._protocol = 1  # until the client asks for 2 (RTDE guide, "Protocol version")
        self._inputs: dict[int, Recipe] = {}
        self._output: Recipe | None = None
        self._readers: list[Reader] = []
        self._every = 1
        self._started = False
        self._last_arrival = 0
        self._handlers: dict[int, Callable[[bytes], bytes]] = {
            PackageType.REQUEST_PROTOCOL_VERSION: self._request_version,
            PackageType.GET_CONTROLLER_VERSION: self._controller_version,
            PackageType.SETUP_OUTPUTS: self._setup_outputs,
            PackageType.SETUP_INPUTS: self._setup_inputs,
            PackageType.START: self._start,
            PackageType.PAUSE: self._pause,
            PackageType.TEXT_MESSAGE: self._text,
        }

    def receive(self, data: bytes, t: int) -> bytes:
        """Replies to what `data` completes at bench time t, ns; WireError when it is not RTDE."""
        replies = b""
        for package in self._cutter.feed(data):
            if package.type == PackageType.DATA:
                replies += self._data(package.payload, t)
            else:
                replies += self._handle(package)
        return replies

    def publish(self, step: int) -> bytes:
        """The data package of this control step, b"" when none is due."""
        if not self._started or self._output is None or step % self._every:
            return b""
        body = self._output.pack([read() for read in self._readers])
        return encode(PackageType.DATA, self._prefix + body)

    def close(self) -> None:
        """Leave: the inputs are free for other clients, their values stay."""
        self._started = False
        self._box.ownership.release(self._client)

    @property
    def _prefix(self) -> bytes:
        """The recipe id of a package; protocol 1 has none."""
        return bytes((OUTPUT_RECIPE,)) if self._protocol == 2 else b""

    def _handle(self, package: Package) -> bytes:
        handler = self._handlers.get(package.type)
        if handler is None:
            return self._warn(f"unknown package type {package.type}")
        reply = handler(package.payload)
        if len(reply) > MAX_REPLY:
            raise WireError(f"RTDE reply of {len(reply)} bytes, allowed are {MAX_REPLY}")
        return reply if package.type == PackageType.TEXT_MESSAGE else encode(package.type, reply)

    def _request_version(self, payload: bytes) -> bytes:
        wanted = decode_protocol_version(payload)
        if wanted in (1, 2):
            self._protocol = wanted
        return encode_accepted(wanted in (1, 2))

    def _controller_version(self, payload: bytes) -> bytes:
        return encode_controller_version(ControllerVersion(*self._box.version))

    def _setup_outputs(self, payload: bytes) -> bytes:
        """Replace the output recipe; sending stops until the next START (the guide is silent)."""
        self._started, self._output = False, None
        rate = float(self._box.robot.rate)
        if self._protocol == 2:
            names, frequency = decode_names_with_frequency(payload)
        else:
            names, frequency = decode_names(payload), rate
        types = [self._output_type(name) for name in names]
        accepted = bool(names) and NOT_FOUND not in types and _sensible(frequency)
        accepted = accepted and self._compile_output(names)
        if accepted:
            # Steps are skipped, never stretched: floor(rate / f), counted in control steps.
            self._every = max(1, floor(rate / frequency))
        recipe_id = OUTPUT_RECIPE if accepted else 0
        return encode_types(types, recipe_id if self._protocol == 2 else None)

    def _output_type(self, name: str) -> str:
        variable = OUTPUTS.get(name)
        known = variable is not None and variable.known_to(self._box.version)
        return variable.type.name if variable is not None and known else NOT_FOUND

    def _compile_output(self, names: tuple[str, ...]) -> bool:
        recipe = Recipe(names, [OUTPUTS[name].type for name in names])
        if recipe.size > MAX_DATA:
            return False
        table = readers(self._box)
        self._output, self._readers = recipe, [table[name] for name in names]
        return True

    def _setup_inputs(self, payload: bytes) -> bytes:
        """Ids count up from 1: ur_rtde never reads them and relies on the order of its requests."""
        names = decode_names(payload)
        taken = self._box.ownership.conflicts(names, self._client)
        types = [IN_USE if name in taken else self._input_type(name) for name in names]
        refused = not names or taken or NOT_FOUND in types
        if refused or len(self._inputs) == MAX_INPUT_RECIPES:
            return encode_types(types, 0)
        self._box.ownership.claim(names, self._client)
        recipe_id = len(self._inputs) + 1
        self._inputs[recipe_id] = Recipe(names, [INPUTS[name].type for name in names])
        return encode_types(types, recipe_id)

    def _input_type(self, name: str) -> str:
        variable = INPUTS.get(name)
        known = variable is not None and variable.known_to(self._box.version)
        return variable.type.name if variable is not None and known else NOT_FOUND

    def _start(self, payload: bytes) -> bytes:
        self._started = self._output is not None
        return encode_accepted(self._started)

    def _pause(self, payload: bytes) -> bytes:
        """Accepted also when nothing was started: ur_rtde's I/O interface ends that way."""
        self._started = False
        return encode_accepted(True)

    def _text(self, payload: bytes) -> bytes:
        self._box.say(f"RTDE client {self._client}: {payload[:200]!r}")
        return b""

    def _data(self, payload: bytes, t: int) -> bytes:
        """Queue input values; they are taken before START and without outputs (ur_rtde does so)."""
        recipe = self._inputs.get(payload[0]) if payload else None
        if recipe is None:
            return self._warn(f"data package for unknown input recipe {payload[:1].hex()}")
        try:
            values = recipe.unpack(payload[1:])
        except WireError as error:
            return self._warn(f"data package discarded: {error}")
        # TCP keeps the order, so a package cannot overtake the one before it.
        self._last_arrival = max(self._last_arrival, t + next(self._delays))
        self._arm.accept(dict(zip(recipe.names, values, strict=True)), self._last_arrival)
        self.commands += 1
        return b""

    def _warn(self, text: str) -> bytes:
        """Log it, and tell the client once it has started: in set-up it would break its order."""
        self._box.doors.note(Event.REFUSED, f"RTDE client {self._client}: {text}")
        if not self._started:
            return b""
        message = TextMessage(text, "RTDE", TextLevel.WARNING)
        return encode(PackageType.TEXT_MESSAGE, encode_text(message))


def _sensible(frequency: float) -> bool:
    return isfinite(frequency) and frequency >= SLOWEST
