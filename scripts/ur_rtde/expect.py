"""What a check may demand of a reading: near a value, or true before long.

All limits are about state. `SOON` only bounds how long a check waits for a state on a busy machine.
"""

import time
from collections.abc import Callable, Sequence

SOON = 8.0
"""s of wall time."""

Reading = Callable[[], Sequence[float]]


def worst(found: Sequence[float], wanted: Sequence[float]) -> float:
    """The largest difference of two vectors; infinite when their lengths differ."""
    if len(found) != len(wanted):
        return float("inf")
    return max(abs(a - b) for a, b in zip(found, wanted, strict=True))


def near(found: Sequence[float], wanted: Sequence[float], tolerance: float) -> None:
    """Both vectors agree in every component."""
    difference = worst(found, wanted)
    assert difference <= tolerance, (
        f"found {rounded(found)}, wanted {rounded(wanted)} within {tolerance:g}"
    )


def becomes(read: Reading, wanted: Sequence[float], tolerance: float, limit: float = SOON) -> None:
    """The reading comes near the wanted vector before long."""
    end = time.monotonic() + limit
    while worst(found := read(), wanted) > tolerance:
        if time.monotonic() > end:
            near(found, wanted, tolerance)
        time.sleep(0.005)


def true_soon(condition: Callable[[], bool], what: str, limit: float = SOON) -> None:
    """The condition comes true before long."""
    end = time.monotonic() + limit
    while not condition():
        assert time.monotonic() < end, f"not before {limit:g} s: {what}"
        time.sleep(0.005)


def stays(read: Reading, tolerance: float, duration: float = 0.15) -> None:
    """The reading does not change for a while."""
    first = read()
    end = time.monotonic() + duration
    while time.monotonic() < end:
        near(read(), first, tolerance)
        time.sleep(0.005)


def equal(found: object, wanted: object) -> None:
    assert found == wanted, f"found {found!r}, wanted {wanted!r}"


def rounded(vector: Sequence[float]) -> list[float]:
    return [round(component, 5) for component in vector]
