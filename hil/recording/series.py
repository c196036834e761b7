"""A recording as columns: what a figure, a table or a spreadsheet wants."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import orjson
from numpy.typing import NDArray

from hil.recording.channel import Channel
from hil.recording.channels.schema import AXES6, STAGE_AXES, WRENCH_AXES
from hil.recording.read import Message, Recording

Array: TypeAlias = NDArray[np.float64]

NS = 1e-9
"""Seconds in a nanosecond."""

SAMPLE = 1_000_000
"""Spacing of the plant's wrenches, ns."""


@dataclass(frozen=True, slots=True)
class Control:
    """/ctrl by period: t in s, wrench in task frame, N and N·m, stage in m and rad."""

    t: Array  # (n,)
    phase: tuple[str, ...]
    k: tuple[int, ...]
    setpoint: Array  # (n, 6)
    wrench: Array  # (n, 6)
    stage: Array  # (n, 4)


@dataclass(frozen=True, slots=True)
class Truth:
    """/plant by period, and /wrench/true by millisecond (t_wrench, wrench in sensor frame)."""

    t: Array  # (n,)
    stage: Array  # (n, 4)
    tip: Array  # (n, 3)
    theta: Array  # (n,)
    depth: Array  # (n,)
    contact: tuple[str, ...]
    part: tuple[str | None, ...]
    t_wrench: Array  # (m,)
    wrench: Array  # (m, 6)


def control(recording: Recording) -> Control:
    """The controller's columns, empty when it was not recorded."""
    found = _of(recording, Channel.CTRL)
    rows = [orjson.loads(message.payload) for message in found]
    return Control(
        t=_times(found),
        phase=tuple(row["phase"] for row in rows),
        k=tuple(row["k"] for row in rows),
        setpoint=_table([[row["setpoint"][axis] for axis in AXES6] for row in rows], 6),
        wrench=_table([[row["wrench"][axis] for axis in WRENCH_AXES] for row in rows], 6),
        stage=_table([[row["stage"][axis] for axis in STAGE_AXES] for row in rows], 4),
    )


def truth(recording: Recording) -> Truth:
    """The plant's columns, empty when it was not recorded."""
    found = _of(recording, Channel.PLANT)
    rows = [orjson.loads(message.payload) for message in found]
    t_wrench, wrench = _wrenches(recording)
    return Truth(
        t=_times(found),
        stage=_table([[row["stage"][axis] for axis in STAGE_AXES] for row in rows], 4),
        tip=_table([[row["tip"][axis] for axis in "xyz"] for row in rows], 3),
        theta=np.array([row["theta"] for row in rows], dtype=np.float64),
        depth=np.array([row["depth"] for row in rows], dtype=np.float64),
        contact=tuple(row["contact"] for row in rows),
        part=tuple(row["part"] for row in rows),
        t_wrench=t_wrench,
        wrench=wrench,
    )


def _wrenches(recording: Recording) -> tuple[Array, Array]:
    """Every true wrench with its time; a period's last one is at the period's end."""
    times: list[float] = []
    wrenches: list[list[float]] = []
    for message in _of(recording, Channel.WRENCH_TRUE):
        samples = orjson.loads(message.payload)["wrenches"]
        first = message.t - (len(samples) - 1) * SAMPLE
        times += [(first + i * SAMPLE) * NS for i in range(len(samples))]
        wrenches += samples
    return np.array(times, dtype=np.float64), _table(wrenches, 6)


def _of(recording: Recording, channel: Channel) -> list[Message]:
    return [message for message in recording.messages if message.topic == channel.topic]


def _times(messages: Sequence[Message]) -> Array:
    return np.array([message.t * NS for message in messages], dtype=np.float64)


def _table(rows: list[list[float]], width: int) -> Array:
    """Rows as an array that keeps its width when there are none."""
    return np.array(rows, dtype=np.float64).reshape(-1, width)
