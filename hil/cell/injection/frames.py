"""What a bad bus does to the node's frames: pure functions of (time, frame) pairs and of dice."""

from typing import Final, TypeAlias

import numpy as np

from drivers.protocol.crc8 import crc8
from drivers.protocol.frame import CanFrame
from drivers.protocol.nrs_can import Identifiers

Timed: TypeAlias = tuple[int, CanFrame]

NS: Final = 1_000_000_000
FRAME: Final = 135_000
"""Longest classic frame of eight bytes at 1 Mbit/s, stuffing included, ns."""
UNKNOWN: Final = CanFrame(0x7FF, b"\xa5" * 8)
BABBLE: Final = CanFrame(0x000, b"\x00" * 8)
"""Identifier 0 wins every arbitration."""
LENGTHS: Final = (6, 7, 0)


def lost(batch: list[Timed], share: float, burst: float, rng: np.random.Generator) -> list[Timed]:
    """Without a share of the frames, `burst` in a row on average."""
    begins = share / (burst * (1.0 - share) + share) if share else 0.0
    kept, losing = [], 0
    for timed in batch:
        if not losing and rng.random() < begins:
            losing = int(rng.geometric(1.0 / burst))
        if losing:
            losing -= 1
        else:
            kept.append(timed)
    return kept


def half(batch: list[Timed], missing: int, share: float, rng: np.random.Generator) -> list[Timed]:
    """Without a share of the frames with this identifier."""
    return [timed for timed in batch if timed[1].id != missing or rng.random() >= share]


def duplicated(batch: list[Timed]) -> list[Timed]:
    return [timed for timed in batch for _ in range(2)]


def reordered(batch: list[Timed], depth: int) -> list[Timed]:
    """Every depth + 1 frames in a row the other way round; moments stay as they were."""
    frames = [frame for _, frame in batch]
    size = depth + 1
    turned = [f for at in range(0, len(frames), size) for f in reversed(frames[at : at + size])]
    return [(t, frame) for (t, _), frame in zip(batch, turned, strict=True)]


def foreign(batch: list[Timed], what: str, ids: Identifiers) -> list[Timed]:
    """Samples cut short (`length`), frames that nobody knows (`unknown`), or both."""
    found: list[Timed] = []
    for number, (t, frame) in enumerate(batch):
        cut = what != "unknown" and is_sample(frame, ids)
        data = frame.data[: LENGTHS[number % len(LENGTHS)]] if cut else frame.data
        found.append((t, frame._replace(data=data)))
        if what != "length":
            found.append((t, UNKNOWN))
    return found


def bent(frame: CanFrame, how: str, bits: int, frozen: int, rng: np.random.Generator) -> CanFrame:
    """A sample with `bits` flipped, all axes zero, or its counter standing at `frozen`."""
    octets = bytearray(frame.data)
    if how == "bits":
        for bit in rng.integers(0, 8 * len(octets), bits).tolist():
            octets[bit // 8] ^= 1 << bit % 8
        return frame._replace(data=bytes(octets))
    if how == "counter":
        octets[18 if frame.fd else 7] = frozen
    elif frame.fd:
        octets[:18] = bytes(18)
    else:
        tail = int.from_bytes(octets, "little") >> 51 << 51
        octets[:] = tail.to_bytes(8, "little")
    if frame.fd:  # the fault lies behind the checksum's making
        octets[-1] = crc8(bytes(octets[:-1]) + bytes((frame.id & 0xFF,)))
    return frame._replace(data=bytes(octets))


def counter_of(frame: CanFrame) -> int:
    return frame.data[18 if frame.fd else 7]


def crowded(batch: list[Timed], load: float, free: int, until: int) -> tuple[list[Timed], int]:
    """When frames get through a bus that frames of higher priority fill to `load`.

    free: when the bus is next free for the node. until: end of the flood, ns. Also the new `free`.
    """
    found: list[Timed] = []
    cycle = round(FRAME / load) if load else FRAME
    for sent, frame in batch:
        start = max(sent, free)
        if load >= 1.0:
            start = max(start, until)
        elif load > 0.0 and start % cycle < FRAME and start < until:
            start = min(until, start - start % cycle + FRAME)
        free = start + FRAME
        found.append((start, frame))
    return found, free


def babble(begin: int, end: int, load: float) -> list[Timed]:
    """The flood itself between two moments, ns."""
    cycle = round(FRAME / load) if load else end - begin
    first = -(-begin // cycle) * cycle
    return [(t, BABBLE) for t in range(first, end, cycle)] if load else []


def is_sample(frame: CanFrame, ids: Identifiers) -> bool:
    return frame.id in (ids.force, ids.torque, ids.wrench_fd)
