"""The channels of a recording, in the order in which records of one moment are written."""

from enum import IntEnum
from typing import NamedTuple


class Channel(IntEnum):
    """The order is part of the file format: it breaks ties between records of the same time."""

    RTDE_IN = 0
    RTDE_OUT = 1
    CAN = 2
    WRENCH = 3
    WRENCH_TRUE = 4
    PLANT = 5
    CTRL = 6
    DEADLINE = 7
    EVENT = 8

    @property
    def topic(self) -> str:
        return TOPICS[self]


TOPICS = (
    "/rtde/in",
    "/rtde/out",
    "/can/raw",
    "/wrench",
    "/wrench/true",
    "/plant",
    "/ctrl",
    "/deadline",
    "/event",
)


class Record(NamedTuple):
    """t: bench time, ns. payload: the channel's packed form, made by `channels.<name>.encode`."""

    t: int
    channel: Channel
    payload: bytes
