"""What happened in a recorded run: phases, contact, forces, trips, counts."""

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import groupby
from operator import itemgetter

import numpy as np
import orjson

from hil.recording import series
from hil.recording.channel import Channel
from hil.recording.channels.event import EventKind
from hil.recording.read import Message, Recording
from hil.recording.series import Control, Truth

INSIDE = ("slot", "bottom")
ENDINGS = (EventKind.OUTCOME, EventKind.GUARD)


@dataclass(frozen=True, slots=True)
class Span:
    """A stretch of time with one name, s."""

    name: str
    start: float
    end: float


@dataclass(frozen=True, slots=True)
class Occurrence:
    """One line at one time, s."""

    t: float
    kind: str
    text: str


@dataclass(frozen=True, slots=True)
class Summary:
    """One run in numbers: s, N, m. None where the run has no such thing.

    f_z: least and largest period mean along the task's z. slot_found: when the tip first entered.
    depth: the tip's greatest depth below the face. outcome: the last event that says how it ended.
    """

    seed: str
    rig: str
    digest: str
    ending: str
    duration: float
    counts: dict[str, int]
    phases: tuple[Span, ...]
    contacts: tuple[Span, ...]
    events: tuple[Occurrence, ...]
    slot_found: float | None
    depth: float | None
    f_z: tuple[float, float] | None
    guard_trips: int
    misses: int
    outcome: str | None


def summarise(recording: Recording) -> Summary:
    """The summary of a whole or cut-off recording."""
    controller, plant = series.control(recording), series.truth(recording)
    events = tuple(_events(recording.messages))
    run = recording.metadata.get("run", {})
    contacts = spans(plant.t, plant.contact)
    return Summary(
        seed=run.get("seed", "?"),
        rig=run.get("rig", "?"),
        digest=recording.digest,
        ending=recording.ending,
        duration=recording.messages[-1].t * 1e-9 if recording.messages else 0.0,
        counts=dict(sorted(Counter(m.topic for m in recording.messages).items())),
        phases=spans(controller.t, controller.phase),
        contacts=contacts,
        events=events,
        slot_found=next((span.start for span in contacts if span.name in INSIDE), None),
        depth=_depth(plant),
        f_z=_normal_force(controller),
        guard_trips=sum(event.kind == EventKind.GUARD for event in events),
        misses=_misses(recording.messages),
        outcome=next((e.text for e in reversed(events) if e.kind in ENDINGS), None),
    )


def spans(t: series.Array, names: Iterable[str]) -> tuple[Span, ...]:
    """Runs of equal names; each lasts until the next begins."""
    starts = [
        next(group) for _, group in groupby(zip(names, t.tolist(), strict=True), itemgetter(0))
    ]
    ends = [start for _, start in starts[1:]] + [float(t[-1])] if starts else []
    return tuple(Span(name, start, end) for (name, start), end in zip(starts, ends, strict=True))


def timeline(summary: Summary) -> list[Occurrence]:
    """Phases, contacts and events in one list by time."""
    phases = [Occurrence(span.start, "phase", span.name) for span in summary.phases]
    contacts = [Occurrence(span.start, "contact", span.name) for span in summary.contacts]
    return sorted([*phases, *contacts, *summary.events], key=lambda entry: entry.t)


def _events(messages: Iterable[Message]) -> Iterator[Occurrence]:
    for message in messages:
        if message.topic == Channel.EVENT.topic:
            event = orjson.loads(message.payload)
            yield Occurrence(message.t * 1e-9, event["kind"], event["text"])


def _depth(plant: Truth) -> float | None:
    return float(plant.depth.max()) if len(plant.t) else None


def _normal_force(controller: Control) -> tuple[float, float] | None:
    if not len(controller.t):
        return None
    f_z = controller.wrench[:, 2]
    return float(np.min(f_z)), float(np.max(f_z))


def _misses(messages: Iterable[Message]) -> int:
    """The running count's last value."""
    last = None
    for message in messages:
        if message.topic == Channel.DEADLINE.topic:
            last = message
    return int(orjson.loads(last.payload)["misses"]) if last else 0
