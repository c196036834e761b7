"""The client's side of RTDE set-up as a dialogue without sockets: requests out, replies in."""

from collections.abc import Generator, Sequence
from typing import Final, NamedTuple, TypeAlias

from drivers.errors import ProtocolError, RecipeError
from drivers.protocol import rtde_setup as setup
from drivers.protocol.rtde import IN_USE, NOT_FOUND, FieldType, Package, PackageType, Recipe, encode

PROTOCOL: Final = 2

_ASYNCHRONOUS: Final = (PackageType.TEXT_MESSAGE, PackageType.DATA)


class Agreement(NamedTuple):
    """What set-up came to: the controller's version, its rate in Hz, and both recipes."""

    version: setup.ControllerVersion
    rate: int
    outputs: Recipe
    output_id: int
    inputs: Recipe
    input_id: int


Dialogue: TypeAlias = Generator[bytes, Package, Agreement]
"""Yields bytes to send (b"" for none), takes the next package, returns the agreement."""


def rate_of(version: setup.ControllerVersion) -> int:
    """Control rate of the series, Hz: CB3 125, e-Series and later 500 (RTDE guide)."""
    return 125 if version.major < 5 else 500


def handshake(outputs: Sequence[str], inputs: Sequence[str]) -> Dialogue:
    """Agree on protocol 2, both recipes at the full rate, and start.

    Raises ProtocolError, RecipeError naming the fields at fault, and WireError.
    """
    reply = yield from _ask(
        PackageType.REQUEST_PROTOCOL_VERSION, setup.encode_protocol_version(PROTOCOL)
    )
    if not setup.decode_accepted(reply):
        raise ProtocolError(f"the controller refuses RTDE protocol {PROTOCOL}; update its software")
    reply = yield from _ask(PackageType.GET_CONTROLLER_VERSION)
    version = setup.decode_controller_version(reply)
    rate = rate_of(version)
    reply = yield from _ask(PackageType.SETUP_OUTPUTS, setup.encode_names(outputs, rate))
    output_recipe, output_id = agreed_recipe(outputs, reply)
    reply = yield from _ask(PackageType.SETUP_INPUTS, setup.encode_names(inputs))
    input_recipe, input_id = agreed_recipe(inputs, reply)
    reply = yield from _ask(PackageType.START)
    if not setup.decode_accepted(reply):
        raise ProtocolError("the controller refuses to start RTDE with an accepted recipe")
    return Agreement(version, rate, output_recipe, output_id, input_recipe, input_id)


def agreed_recipe(names: Sequence[str], reply: bytes) -> tuple[Recipe, int]:
    """The recipe and id in a set-up reply; RecipeError when a field was refused."""
    types, recipe_id = setup.decode_types_with_id(reply)
    if len(types) != len(names):
        raise ProtocolError(f"{len(types)} types for a recipe of {len(names)} fields")
    _refuse(names, types, NOT_FOUND, "the controller's software does not know")
    _refuse(names, types, IN_USE, "another client (or EtherNet/IP, PROFINET) owns")
    if recipe_id == 0:
        raise RecipeError(f"the controller refuses the recipe {', '.join(names)}")
    try:
        return Recipe(names, [FieldType[name] for name in types]), recipe_id
    except KeyError as error:
        raise ProtocolError(f"the controller names a field type {error} that RTDE lacks") from None


def _refuse(names: Sequence[str], types: Sequence[str], verdict: str, reason: str) -> None:
    refused = [name for name, type in zip(names, types, strict=True) if type == verdict]
    if refused:
        raise RecipeError(f"{reason} {', '.join(refused)}")


def _ask(type: PackageType, payload: bytes = b"") -> Generator[bytes, Package, bytes]:
    """Send a request; the payload of its reply. Data and text may come in between."""
    reply = yield encode(type, payload)
    while reply.type in _ASYNCHRONOUS:
        reply = yield b""
    if reply.type != type:
        raise ProtocolError(f"reply of type {reply.type} to {type.name}, allowed is {type.value}")
    return reply.payload
