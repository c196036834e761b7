"""Serve a rig's cell in this thread until somebody says stop; say on demand how it is doing."""

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import NamedTuple

import orjson

from hil.app.desk import open_desk
from hil.app.pacing import keep, schedule
from hil.app.tap import ignore
from hil.cell.clock import Lateness
from hil.cell.rig import Rig
from hil.cell.serve import Doors, Traffic

Announce = Callable[[Doors, str], None]
"""Told once where the cell can be reached, and a line about its bus."""


class Status(NamedTuple):
    """How a served cell is doing. lateness: None in lockstep."""

    rig: str
    clock: str
    host: str
    rtde: int
    traffic: Traffic
    lateness: Lateness | None

    def to_json(self) -> bytes:
        """For a wire or a program."""
        flat = self._asdict() | {"traffic": self.traffic._asdict()}
        late = self.lateness
        return orjson.dumps(flat | {"lateness": None if late is None else late._asdict()})

    @classmethod
    def from_json(cls, text: bytes) -> "Status":
        """Back again; ValueError for what `to_json` did not make."""
        found = orjson.loads(text)
        try:
            late = found.pop("lateness")
            traffic = Traffic(**found.pop("traffic"))
            lateness = None if late is None else Lateness(**late)
            return cls(**found, traffic=traffic, lateness=lateness)
        except (AttributeError, KeyError, TypeError) as error:
            raise ValueError(f"no status of a cell: {error}") from None


Tell = Callable[[Status], None]
"""Told how the cell is doing: at SIGUSR1, and when it has stopped."""


def up(
    rig: Rig, seed: int, clock: str, announce: Announce, tell: Tell, *, powered: bool = False
) -> None:
    """Open the doors, announce them, run until SIGINT or SIGTERM; raises DoorError.

    powered: the arm releases its brakes by itself.
    """
    from hil.cell.arm.urscript import compile_program  # noqa: PLC0415
    from hil.cell.assemble import serve  # noqa: PLC0415  MuJoCo loads only with a cell

    compile_program("sync()")  # the parser's tables, 0.2 s that no client's first program waits for
    with _signals() as came, serve(rig, seed, across_processes=True) as cell, open_desk() as desk:
        if powered:
            cell.power_up()
        announce(cell.doors, cell.describe())
        pacer = schedule(cell, clock)

        def status() -> Status:
            late = None if pacer is None else pacer.lateness()
            doors = cell.doors
            return Status(rig.name, clock, doors.host, doors.ports["rtde"], cell.traffic(), late)

        def stopped() -> bool:
            desk(lambda: status().to_json())
            if signal.SIGUSR1 in came:
                came.remove(signal.SIGUSR1)
                tell(status())
            return bool(came)

        keep(cell, pacer, stopped, ignore)
        tell(status())


@contextmanager
def _signals() -> Iterator[list[int]]:
    """The signals that came: they end nothing themselves, so a period is never cut in two."""
    came: list[int] = []

    def note(number: int, _frame: FrameType | None) -> None:
        came.append(number)

    heeded = (signal.SIGINT, signal.SIGTERM, signal.SIGUSR1)
    before = {number: signal.signal(number, note) for number in heeded}
    try:
        yield came
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
