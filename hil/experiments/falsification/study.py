"""Runs to the first violation of three planted bugs, by way of searching; same budget for all."""

from collections.abc import Iterator
from functools import partial
from itertools import product
from statistics import median
from typing import Final, NamedTuple, cast

from hypothesis import HealthCheck, Phase, given, settings, target
from hypothesis import seed as seeded
from hypothesis import strategies as st

from hil.cell.rig import Rig
from hil.experiments.falsification.bugs import Bug
from hil.experiments.falsification.contact import robustness
from hil.falsify.faults import space
from hil.falsify.search import Robustness, Sampler, search
from hil.falsify.space import Axes, Axis, Case, Choice, Part, Space, Value

PRESS: Final[Space] = {
    "press": {
        "stiffness": Axis(1e3, 100e3, neutral=1e3, log=True, likely=100e3),
        "gap": Axis(0.5e-3, 2e-3, neutral=0.5e-3),
        "approach": Axis(2e-3, 16e-3, neutral=2e-3, likely=16e-3),
    }
}
WHERE: Final = Choice(("phase: approach", "contact"))
WAYS: Final = ("tpe", "likely", "random", "target")
BUGS: Final = (Bug.FILLED, Bug.QUEUE, Bug.RETARE)


class Count(NamedTuple):
    """Runs until the bug was found; None: not within the budget."""

    bug: Bug
    way: str
    seed: int
    runs: int | None


def slots() -> tuple[Space, Space]:
    """How the arm presses, and one fault of the bus after an event that this job has."""
    faults = space(("C1", "C2"))
    return PRESS, {kind: {**axes, "event": WHERE} for kind, axes in faults.items()}


def study(rig: Rig, *, seeds: int, budget: int) -> Iterator[Count]:
    """Every seed, every bug, every way; a study that is cut off has the same seeds of each."""
    for seed, bug, way in product(range(1, seeds + 1), BUGS, WAYS):
        judge = partial(robustness, rig, bug=bug, seed=seed)
        yield Count(bug, way, seed, runs_to_find(way, judge, budget=budget, seed=seed))


def runs_to_find(way: str, judge: Robustness, *, budget: int, seed: int) -> int | None:
    """Runs to the first violation."""
    if way == "target":
        return _climbed(judge, budget, seed)
    found = search(slots(), judge, budget=budget, seed=seed, sampler=cast("Sampler", way))
    return found.runs if found.violated else None


def medians(counts: list[Count], budget: int) -> dict[tuple[Bug, str], tuple[float, int]]:
    """Median runs by bug and way, one that was not found counting as the whole budget, and how
    often it was found.
    """
    cells = {(count.bug, count.way) for count in counts}
    return {
        (bug, way): (
            median(c.runs or budget for c in counts if (c.bug, c.way) == (bug, way)),
            sum(c.runs is not None for c in counts if (c.bug, c.way) == (bug, way)),
        )
        for bug, way in sorted(cells)
    }


class _FoundIt(Exception):  # noqa: N818  no error: what was looked for
    pass


def _climbed(judge: Robustness, budget: int, seed: int) -> int | None:
    """The same with hypothesis, which is told the robustness as its target."""
    runs = 0

    @seeded(seed)
    @settings(
        max_examples=budget,
        database=None,
        deadline=None,
        phases=(Phase.generate, Phase.target),
        suppress_health_check=list(HealthCheck),
        report_multiple_bugs=False,
    )
    @given(st.tuples(*map(_slot, slots())))
    def climb(case: Case) -> None:
        nonlocal runs
        runs += 1
        value = judge(case)
        target(-value)
        if value < 0.0:
            raise _FoundIt

    try:
        climb()
    except _FoundIt:
        return runs - 1  # hypothesis runs what failed once more
    return None


def _slot(of: Space) -> st.SearchStrategy[Part]:
    return st.one_of([_part(kind, axes) for kind, axes in of.items()])


def _part(kind: str, axes: Axes) -> st.SearchStrategy[Part]:
    values = st.fixed_dictionaries({name: _value(axis) for name, axis in axes.items()})
    return st.builds(Part, st.just(kind), values)


def _value(axis: Axis | Choice) -> st.SearchStrategy[Value]:
    if isinstance(axis, Choice):
        return st.sampled_from(axis.words)
    if axis.whole:
        return st.integers(round(axis.low), round(axis.high))
    if axis.log:
        return st.floats(0.0, 1.0).map(lambda x: float(axis.low * (axis.high / axis.low) ** x))
    return st.floats(axis.low, axis.high)
