"""The catalogue as a space to search, and a case of it as a schedule that a run takes."""

from collections.abc import Iterable
from typing import Final

from hil.cell.faults.catalogue import row
from hil.cell.faults.event import event
from hil.cell.faults.row import Parameter, Phase, Row
from hil.cell.faults.schedule import Fault, Schedule
from hil.cell.faults.span import Span
from hil.cell.faults.trigger import AT_ONCE, Trigger
from hil.falsify.space import Axes, Axis, Case, Choice, Part, Space, Value

LATEST: Final = 60
"""Control periods after its event at which a fault begins at the latest."""
LONGEST: Final = 100
"""Control periods that a fault lasts at most."""
REACH: Final = 10.0
"""A parameter goes up to so many times its default, or to this where that is 0."""


def space(kinds: Iterable[str]) -> Space:
    """Axes of each fault: its parameters, the event it follows, how much later, how long.

    FaultError for a kind that does not exist.
    """
    rows = [row(kind) for kind in kinds]
    return {one.id: {**_trigger(one), **_parameters(one)} for one in rows}


def schedule(case: Case) -> Schedule:
    """The faults of a case, in its order."""
    return Schedule(tuple(map(_fault, case)))


class Described:
    """A schedule as a case of a space of its own, so that parts of it can be varied and dropped.

    Triggers at a time or by chance, and durations in seconds, are kept as they are.
    """

    def __init__(self, of: Schedule) -> None:
        self._faults = of.faults
        self.case: Case = tuple(_described(f"{n}", one) for n, one in enumerate(of.faults))
        self.space: Space = {
            part.kind: _axes(one, part) for part, one in zip(self.case, of.faults, strict=True)
        }

    def schedule(self, case: Case) -> Schedule:
        """The faults of a variation of it."""
        return Schedule(tuple(_varied(self._faults[int(part.kind)], part) for part in case))

    def name(self, part: Part, axis: str) -> str:
        """An axis as people read it: `C1.share`."""
        return f"{self._faults[int(part.kind)].kind}.{axis.removeprefix('params.')}"


def _described(kind: str, of: Fault) -> Part:
    values: dict[str, Value] = {f"params.{name}": value for name, value in of.parameters.items()}
    begins, lasts = of.trigger, of.duration
    if begins.event is not None and not begins.offset.ns:
        values |= {"event": str(begins.event), "offset": begins.offset.cycles}
    if lasts is not None and not lasts.ns:
        values["cycles"] = lasts.cycles
    return Part(kind, values)


def _axes(of: Fault, part: Part) -> Axes:
    """Of the values that the part has; wide enough for them."""
    axes = {**_trigger(of.row), **_parameters(of.row)}
    return {name: axes[name].reaching(value) for name, value in part.values.items()}


def _varied(of: Fault, part: Part) -> Fault:
    new = _fault(Part(of.kind, part.values))
    begins = new.trigger if "event" in part.values else of.trigger
    lasts = new.duration if "cycles" in part.values else of.duration
    return Fault(of.kind, new.parameters, begins, lasts)


def _trigger(of: Row) -> Axes:
    if of.start:
        return {}
    axes: dict[str, Axis | Choice] = {
        "event": Choice(tuple(_event(phase) for phase in of.phases)),
        "offset": Axis(0, LATEST, neutral=0, whole=True),
    }
    return axes | ({"cycles": Axis(1, LONGEST, neutral=1, whole=True)} if of.lasting else {})


def _event(phase: Phase) -> str:
    """A phase that begins where something happens is named by that: it is later than its name."""
    return "contact" if phase is Phase.CONTACT else f"phase: {phase}"


def _parameters(of: Row) -> Axes:
    return {f"params.{one.name}": _axis(one) for one in of.parameters}


def _axis(of: Parameter) -> Axis | Choice:
    if of.choices:
        return Choice(of.choices)
    high = min(of.high, REACH * abs(float(of.default)) or REACH)
    low = max(of.low, -high)
    neutral = min(max(0.0, low), high)
    likely = float(of.default) if float(of.default) > 0.0 else None
    return Axis(low, high, neutral, whole=of.whole, likely=likely)


def _fault(part: Part) -> Fault:
    values = dict(part.values)
    begins = AT_ONCE
    if "event" in values:
        offset = Span(cycles=int(values["offset"]))
        begins = Trigger(event=event("event", values["event"]), offset=offset)
    lasts = Span(cycles=int(values["cycles"])) if "cycles" in values else None
    given = {
        name.removeprefix("params."): value
        for name, value in values.items()
        if name.startswith("params.")
    }
    return Fault(part.kind, given, begins, lasts)
