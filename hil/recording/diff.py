"""Where two recordings first differ: identity, channel, time and field."""

import hashlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import zip_longest

import orjson

from hil.recording.read import Message, Recording

ABSENT = "(absent)"


@dataclass(frozen=True, slots=True)
class Difference:
    """One field that two messages do not share; t in ns, values as JSON or `(absent)`."""

    topic: str
    t: int
    field: str
    left: str
    right: str


@dataclass(frozen=True, slots=True)
class Comparison:
    """identity: metadata and attachments that differ, (name, left, right). message: the first."""

    identity: tuple[tuple[str, str, str], ...]
    message: Difference | None

    @property
    def same(self) -> bool:
        return not self.identity and self.message is None


def compare(left: Recording, right: Recording) -> Comparison:
    """The identity's differences and the first differing message."""
    return Comparison(tuple(_identities(left, right)), _first(left.messages, right.messages))


def _identities(left: Recording, right: Recording) -> Iterator[tuple[str, str, str]]:
    ours, theirs = _flat(left), _flat(right)
    for name in sorted(ours.keys() | theirs.keys()):
        a, b = ours.get(name, ABSENT), theirs.get(name, ABSENT)
        if a != b:
            yield name, a, b


def _flat(recording: Recording) -> dict[str, str]:
    """Identity as text by name; a complete and a cut-off file differ in `ending`."""
    flat = {
        f"{record}.{key}": value
        for record, entries in recording.metadata.items()
        for key, value in entries.items()
    }
    bodies = {
        name: hashlib.sha256(body).hexdigest() for name, body in recording.attachments.items()
    }
    return flat | bodies | {"ending": recording.ending or "complete"}


def _first(left: Sequence[Message], right: Sequence[Message]) -> Difference | None:
    for a, b in zip_longest(left, right):
        if a != b:
            return _difference(a, b)
    return None


def _difference(a: Message | None, b: Message | None) -> Difference:
    if a is not None and b is not None and (a.t, a.topic) == (b.t, b.topic):
        ours, theirs = orjson.loads(a.payload), orjson.loads(b.payload)
        field, x, y = next(_fields(ours, theirs, ""), ("sequence", a.sequence, b.sequence))
        return Difference(a.topic, a.t, field, _text(x), _text(y))
    # Messages are ordered by time: the earlier of the two is the one the other file has not.
    if b is None or (a is not None and a.t <= b.t):
        assert a is not None
        return Difference(a.topic, a.t, "", a.payload.decode(), ABSENT)
    return Difference(b.topic, b.t, "", ABSENT, b.payload.decode())


def _fields(a: object, b: object, path: str) -> Iterator[tuple[str, object, object]]:
    """Leaves that differ, depth first, as (path, left, right)."""
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        for key in [*a, *(key for key in b if key not in a)]:
            dotted = f"{path}.{key}" if path else str(key)
            yield from _fields(a.get(key, ABSENT), b.get(key, ABSENT), dotted)
    elif isinstance(a, list) and isinstance(b, list):
        for index, (x, y) in enumerate(zip_longest(a, b, fillvalue=ABSENT)):
            yield from _fields(x, y, f"{path}[{index}]")
    elif a != b or type(a) is not type(b):
        yield path, a, b


def _text(value: object) -> str:
    return ABSENT if value is ABSENT else orjson.dumps(value).decode()
