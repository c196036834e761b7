"""The dashboard's line protocol: ASCII lines one way and the other, one reply a command."""

from typing import Final

from drivers.protocol.errors import WireError

GREETING: Final = "Connected: Universal Robots Dashboard Server"
"""First line of every connection, before any command."""

MAX_LINE: Final = 4096
"""Far above any documented command or reply; keeps a peer without line ends from filling memory."""


def encode(line: str) -> bytes:
    """One line as bytes; ValueError for a line break inside, which would be a second command."""
    if "\n" in line or "\r" in line:
        raise ValueError(f"a dashboard line cannot hold a line break: {line!r}")
    return line.encode("utf-8") + b"\n"


class LineCutter:
    """Cuts a byte stream into lines; what it keeps is never more than one partial line."""

    __slots__ = ("_rest",)

    def __init__(self) -> None:
        self._rest = b""

    def feed(self, data: bytes) -> list[str]:
        """The lines that `data` completes, without line ends; WireError beyond MAX_LINE."""
        *lines, self._rest = (self._rest + data).split(b"\n")
        longest = max(map(len, (*lines, self._rest)))
        if longest > MAX_LINE:
            raise WireError(f"dashboard line of {longest} bytes, allowed are {MAX_LINE}")
        return [line.rstrip(b"\r").decode("utf-8", "replace") for line in lines]
