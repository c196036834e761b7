"""Which part of a recording is worth a picture, and the true force as it would read tared."""

from typing import NamedTuple

import numpy as np

from hil.recording.series import Array, Control, Truth
from hil.recording.summary import Span, spans

FIRST, LAST = "contact", "retract"
"""Phases at which the picture begins and ends."""


class Window(NamedTuple):
    """The stretch shown, s."""

    start: float
    end: float

    def holds(self, t: Array) -> "np.typing.NDArray[np.bool_]":
        return (t >= self.start) & (t <= self.end)


def assembly(controller: Control, plant: Truth) -> Window:
    """From the last lowering onto the face to the retreat; the whole run when it never came so far.

    The way there and back is a hundred times longer than the slot is deep: it would hide it.
    """
    t = controller.t if len(controller.t) else plant.t
    if not len(t):
        return Window(0.0, 0.0)
    named = spans(controller.t, controller.phase)
    start = max((span.start for span in named if span.name == FIRST), default=float(t[0]))
    ends = (span.start for span in named if span.name == LAST and span.start > start)
    return Window(start, min(ends, default=float(t[-1])))


def phases(controller: Control, window: Window) -> list[Span]:
    """The window's phases, clipped to it."""
    return [
        Span(span.name, max(span.start, window.start), min(span.end, window.end))
        for span in spans(controller.t, controller.phase)
        if span.end > window.start and span.start < window.end
    ]


def true_normal_force(plant: Truth, window: Window) -> tuple[Array, Array]:
    """Time and true f_z in task frame at 1 kHz, N, less its median without contact.

    The true wrench holds the tool's weight, which the sensor's tare takes away.
    """
    shown = window.holds(plant.t_wrench)
    t, f_z = plant.t_wrench[shown], -plant.wrench[shown, 2]
    if not len(plant.t) or not len(t):
        return t, f_z
    period = np.clip(np.searchsorted(plant.t, t - 1e-9), 0, len(plant.t) - 1)
    free = np.array([contact == "free" for contact in plant.contact])[period]
    return t, f_z - (np.median(f_z[free]) if free.any() else 0.0)
