"""The far side's part of a recording: bus traffic and truth of each period, packed at once."""

from hil.cell.serve import Tick
from hil.recording.channel import Channel
from hil.recording.channels import can, plant, truth

Entry = tuple[int, Channel, bytes]


def ignore(_: Tick) -> None:
    """The observer of a cell whose periods nobody records."""


def entries(tick: Tick) -> tuple[Entry, Entry, Entry]:
    """What is recorded of one period: bench time, ns, channel, payload."""
    return (
        (tick.t, Channel.CAN, can.encode(tick.frames)),
        (tick.t, Channel.WRENCH_TRUE, truth.encode(tick.truth.wrenches)),
        (tick.t, Channel.PLANT, plant.encode(tick.truth)),
    )
