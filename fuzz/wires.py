"""Targets of the byte protocols: whatever comes, they raise the wire's error or nothing.

A stream is cut at several places too: what it says may not depend on how TCP splits it.
"""

from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Protocol, TypeVar

from drivers.protocol import dashboard, nrs_tcp, primary, rtde, rtde_setup
from drivers.protocol.can_error import decode_error
from drivers.protocol.errors import WireError
from drivers.protocol.nrs_can import Identifiers, ProtocolError
from drivers.protocol.nrs_command import decode_command, decode_reply
from drivers.protocol.nrs_sample import decode_fd, decode_pair
from drivers.protocol.nrs_status import decode_emergency, decode_heartbeat, decode_status
from drivers.protocol.primary_messages import decode_message
from drivers.protocol.primary_state import decode_state
from drivers.protocol.realtime import Record
from fuzz.target import Target

T_co = TypeVar("T_co", covariant=True)
PIECES = (1, 7)


class Cutter(Protocol[T_co]):
    def feed(self, data: bytes, /) -> Sequence[T_co]: ...


def said(cutter: Cutter[T_co], pieces: Sequence[bytes]) -> tuple[list[T_co], bool]:
    """What a stream says in these pieces, and whether it was refused."""
    found: list[T_co] = []
    for piece in pieces:
        try:
            found += cutter.feed(piece)
        except WireError:
            return found, True
    return found, False


def stream(make: Callable[[], Cutter[T_co]], octets: bytes) -> list[T_co]:
    """The messages of a stream, refused or not; wrong when they depend on where it is cut."""
    whole, refused = said(make(), [octets])
    for size in PIECES:
        pieces = [octets[at : at + size] for at in range(0, len(octets), size)]
        found, refused_too = said(make(), pieces)
        assert refused == refused_too, f"refused in pieces of {size} or whole, not both"
        assert refused or found == whole, f"pieces of {size} say something else"
    return whole


def allowed(
    decode: Callable[..., object], *arguments: object, error: type[Exception] = WireError
) -> None:
    """Decode; the protocol's own error is all right."""
    with suppress(error):
        decode(*arguments)


def check_rtde(octets: bytes) -> None:
    """Framing, then every set-up payload of every package."""
    for package in stream(rtde.Cutter, octets):
        for decode in (
            rtde_setup.decode_protocol_version,
            rtde_setup.decode_controller_version,
            rtde_setup.decode_accepted,
            rtde_setup.decode_names,
            rtde_setup.decode_names_with_frequency,
            rtde_setup.decode_types,
            rtde_setup.decode_types_with_id,
            rtde_setup.decode_text,
            rtde_setup.decode_text_v1,
        ):
            allowed(decode, package.payload)


def check_rtde_recipe(octets: bytes) -> None:
    """A data package's body against recipes that its first bytes choose."""
    kinds = list(rtde.FieldType)
    count = 1 + (octets[0] % 8 if octets else 0)
    types = [kinds[octet % len(kinds)] for octet in octets[1 : 1 + count]] or [kinds[0]]
    recipe = rtde.Recipe([f"v{n}" for n in range(len(types))], types)
    body = octets[1 + count :]
    allowed(recipe.unpack, body)
    if len(body) >= recipe.size:
        values = recipe.unpack(body[: recipe.size])
        again = recipe.unpack(recipe.pack(values))
        assert repr(again) == repr(values), "a value changed on its way"  # nan is not nan


def check_dashboard(octets: bytes) -> None:
    stream(dashboard.LineCutter, octets)


def check_primary(octets: bytes) -> None:
    for package in stream(primary.Cutter, octets):
        allowed(decode_state, package.body)
        allowed(decode_message, package.body)
    allowed(decode_state, octets)
    allowed(decode_message, octets)


def check_realtime(octets: bytes) -> None:
    for version in ((3, 15), (5, 11)):
        record = Record(version)
        allowed(record.unpack, octets)
        padded = octets.ljust(record.size, b"\xff")[: record.size]
        allowed(record.unpack, padded)


def check_nrs_can(octets: bytes) -> None:
    """Every frame that either end may hear, classic and FD, and the kernel's error frames."""
    ids, half = Identifiers.of(1), len(octets) // 2
    for decode in (decode_command, decode_reply, decode_status, decode_heartbeat, decode_emergency):
        for payload in (octets, octets[:8].ljust(8, b"\0"), octets[:1]):
            allowed(decode, payload, error=ProtocolError)
    allowed(decode_pair, octets[:half], octets[half:], error=ProtocolError)
    allowed(decode_pair, octets[:8], octets[8:16], error=ProtocolError)
    allowed(decode_fd, ids, octets, error=ProtocolError)
    decode_error(int.from_bytes(octets[:4]), octets[4:])


def check_nrs_tcp(octets: bytes) -> None:
    for message in stream(nrs_tcp.Cutter, octets):
        allowed(nrs_tcp.decode_wrench, message.payload)


_RECIPE = rtde_setup.encode_names(("timestamp", "actual_q"), 125.0)

TARGETS = {
    "rtde": Target(
        check_rtde,
        (
            rtde.encode(rtde.PackageType.REQUEST_PROTOCOL_VERSION, b"\0\2"),
            rtde.encode(rtde.PackageType.SETUP_OUTPUTS, _RECIPE),
            rtde.encode(rtde.PackageType.TEXT_MESSAGE, b"\2hi\2me\2"),
        ),
        (b"timestamp", b"NOT_FOUND", b"DOUBLE", b"VECTOR6D", b","),
    ),
    "rtde-recipe": Target(check_rtde_recipe, (b"\1\5" + bytes(8),)),
    "dashboard": Target(check_dashboard, (b"robotmode\n", b"load x.urp\nplay\n")),
    "primary": Target(check_primary, (primary.encode(16, bytes(20)), primary.encode(20, bytes(9)))),
    "realtime": Target(check_realtime, (bytes(1060), bytes(1116))),
    "nrs-can": Target(check_nrs_can, (bytes(8), bytes(16), bytes(24))),
    "nrs-tcp": Target(check_nrs_tcp, (nrs_tcp.encode(7, 1), nrs_tcp.encode_wrench((1.0,) * 6))),
}
