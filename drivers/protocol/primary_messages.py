"""Robot messages of the primary interface: what the controller tells its clients as it happens.

Layouts: UR's client interface manual, "Robot messages". Timestamps are controller time, ns; the
manual gives no unit.
"""

import struct
from collections.abc import Callable, Mapping
from enum import IntEnum
from typing import Final, NamedTuple, TypeAlias

from drivers.protocol.errors import WireError
from drivers.protocol.primary import PackageType, encode

_HEAD: Final = struct.Struct(">QbB")
_ERROR: Final = struct.Struct(">iiiII")
_KEY: Final = struct.Struct(">iiB")
_PLACE: Final = struct.Struct(">ii")
_POPUP: Final = struct.Struct(">IB???B")
_SAFETY: Final = struct.Struct(">iiBII")
_VERSION: Final = struct.Struct(">BBii")


class Source(IntEnum):
    """Who speaks (manual, "Message sources")."""

    ROBOT_INTERFACE = -2
    RT_MACHINE = -3
    CONTROLLER = 7


class Level(IntEnum):
    """How serious an error code is; a client that waits for its script gives up from WARNING on."""

    INFO = 1
    WARNING = 2
    VIOLATION = 3
    FAULT = 4


class Text(NamedTuple):
    """A line of textmsg()."""

    text: str


class Popup(NamedTuple):
    title: str
    text: str
    warning: bool = False
    error: bool = False
    blocking: bool = False


class Version(NamedTuple):
    """numbers: major, minor, bugfix, build."""

    numbers: tuple[int, ...]
    date: str
    project: str = "URControl"


class SafetyModeChange(NamedTuple):
    mode: int


class ErrorCode(NamedTuple):
    """C<code>A<argument>."""

    code: int
    argument: int
    level: Level
    text: str


class Key(NamedTuple):
    """title: what happened, such as PROGRAM_XXX_STARTED. text: to which program."""

    title: str
    text: str


class RuntimeException(NamedTuple):
    """line and column count from 1."""

    line: int
    column: int
    text: str


Message: TypeAlias = Text | Popup | Version | SafetyModeChange | ErrorCode | Key | RuntimeException


def encode_message(message: Message, t: int) -> bytes:
    """One package with `message` of controller time t, ns."""
    kind, source, body = _body(message)
    return encode(PackageType.ROBOT_MESSAGE, _HEAD.pack(t, source, kind) + body)


def decode_message(body: bytes) -> tuple[int, Message | None]:
    """Timestamp, ns, and message of a ROBOT_MESSAGE package; None for types not listed here."""
    try:
        t, _, kind = _HEAD.unpack_from(body)
        reader = _READERS.get(kind)
        return t, None if reader is None else reader(body[_HEAD.size :])
    except (struct.error, ValueError) as error:
        raise WireError(f"robot message of {len(body)} bytes cannot be read: {error}") from None


def _body(message: Message) -> tuple[int, Source, bytes]:  # noqa: PLR0911 - one a message type
    match message:
        case Text(text):
            return 0, Source.CONTROLLER, text.encode()
        case Popup(title, text, warning, error, blocking):
            name = _short(title)
            head = _POPUP.pack(0, 0, warning, error, blocking, len(name))
            return 2, Source.CONTROLLER, head + name + text.encode()
        case Version(numbers, date, project):
            name = _short(project)
            numbers_of = _VERSION.pack(*numbers)
            return (
                3,
                Source.ROBOT_INTERFACE,
                bytes((len(name),)) + name + numbers_of + date.encode(),
            )
        case SafetyModeChange(mode):
            return 5, Source.RT_MACHINE, _SAFETY.pack(0, 0, mode, 0, 0)
        case ErrorCode(code, argument, level, text):
            return 6, Source.RT_MACHINE, _ERROR.pack(code, argument, level, 0, 0) + text.encode()
        case Key(title, text):
            name = _short(title)
            return 7, Source.ROBOT_INTERFACE, _KEY.pack(0, 0, len(name)) + name + text.encode()
        case RuntimeException(line, column, text):
            return 10, Source.RT_MACHINE, _PLACE.pack(line, column) + text.encode()


def _short(text: str) -> bytes:
    return text.encode()[:255]


def _titled(body: bytes, at: int, size: int) -> tuple[str, str]:
    """The title of `size` bytes at `at`, and the text after it."""
    if len(body) < at + size:
        raise ValueError(f"a title of {size} bytes does not fit")
    return _written(body[at : at + size]), _written(body[at + size :])


def _written(raw: bytes) -> str:
    return raw.decode("utf-8", "replace")


def _popup(body: bytes) -> Popup:
    _, _, warning, error, blocking, size = _POPUP.unpack_from(body)
    title, text = _titled(body, _POPUP.size, size)
    return Popup(title, text, warning, error, blocking)


def _version(body: bytes) -> Version:
    if not body:
        raise ValueError("no project name")
    end = 1 + body[0]
    numbers = _VERSION.unpack_from(body, end)
    return Version(numbers, _written(body[end + _VERSION.size :]), _written(body[1:end]))


def _safety_mode(body: bytes) -> SafetyModeChange:
    return SafetyModeChange(_SAFETY.unpack_from(body)[2])


def _error(body: bytes) -> ErrorCode:
    code, argument, level, _, _ = _ERROR.unpack_from(body)
    return ErrorCode(code, argument, Level(level), _written(body[_ERROR.size :]))


def _key(body: bytes) -> Key:
    return Key(*_titled(body, _KEY.size, _KEY.unpack_from(body)[2]))


def _exception(body: bytes) -> RuntimeException:
    line, column = _PLACE.unpack_from(body)
    return RuntimeException(line, column, _written(body[_PLACE.size :]))


_READERS: Final[Mapping[int, Callable[[bytes], Message]]] = {
    0: lambda body: Text(_written(body)),
    2: _popup,
    3: _version,
    5: _safety_mode,
    6: _error,
    7: _key,
    10: _exception,
}
