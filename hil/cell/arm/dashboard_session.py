"""One dashboard client's session: lines in, reply lines out, no sockets."""

from typing import Final

from drivers.protocol.errors import WireError
from hil.cell.arm.controller import ArmController
from hil.cell.arm.dashboard_commands import COMMANDS, Command

MAX_LINE: Final = 4096
"""Far above any command; the longest carry a file name."""

SHARE: Final = 1 << 11
"""Empty lines, 1 us each, cost 2 ms at most."""

_LONGEST: Final = max(len(name.split(" ")) for name in COMMANDS)


class DashboardSession:
    """closing: the client said `quit`, or the box shuts down, and the reply is the last."""

    lossy = False
    share = SHARE
    greeting = b"Connected: Universal Robots Dashboard Server\n"

    def __init__(self, arm: ArmController) -> None:
        self.closing = False
        self._arm = arm
        self._rest = b""

    def receive(self, data: bytes, t: int) -> bytes:
        """Replies to the lines that `data` completes; WireError for a line without an end."""
        *lines, self._rest = (self._rest + data).split(b"\n")
        if len(self._rest) > MAX_LINE:
            raise WireError(f"dashboard line over {MAX_LINE} bytes")
        replies = [self._answer(line.decode("utf-8", "replace").strip()) for line in lines]
        return "".join(f"{reply}\n" for reply in replies).encode()

    def publish(self, step: int) -> bytes:
        """Nothing: the dashboard only answers."""
        return b""

    def close(self) -> None:
        """Leave no trace: the dashboard holds nothing for a client."""

    def _answer(self, line: str) -> str:
        name, command, argument = _find(line)
        if command is None or not command.known_to(self._arm.box.version):
            return f"could not understand: '{line}'"
        self.closing |= name == "quit"
        return command.reply(self._arm, argument)


def _find(line: str) -> tuple[str, Command | None, str]:
    """The command that a line names, longest name first, and its argument."""
    words = line.split(" ")
    for count in range(min(len(words), _LONGEST), 0, -1):
        name = " ".join(words[:count]).lower()
        if (command := COMMANDS.get(name)) is not None:
            return name, command, " ".join(words[count:])
    return line, None, ""
