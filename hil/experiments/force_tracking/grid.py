"""The experiment's grid: which series are run, and what a user may ask of them."""

from dataclasses import dataclass
from math import isfinite
from typing import NamedTuple

from controller.laws.build import law_class
from hil.experiments.force_tracking.presets import TUNED, parameters
from hil.experiments.force_tracking.variant import Variant, axis_of

RIGS = {125: "surface_ur5", 500: "surface_ur5e"}
"""The shipped rig of each control rate, Hz."""
CABLE_RIGS = {125: "ffc_ur5", 500: "ffc_ur5e"}
"""The same for a cable on its connector."""


@dataclass(frozen=True, slots=True)
class Grid:
    """stiffnesses: k_e, N/mm. latencies: ms. force: f_d, N. approach, push, slide: mm/s.

    bottoming: push (N) and stiffness (N/mm) of a surface that turns stiff, (0, ...) for none.
    """

    laws: tuple[str, ...] = ("constant", "duan", "paper", "soft")
    stiffnesses: tuple[float, ...] = (1.0, 3.0, 10.0, 30.0, 100.0)
    latencies: tuple[float, ...] = (6.0, 10.0)
    force: float = 10.0
    approach: float = 4.0
    push: float = 16.0
    slide: float = 20.0
    bottoming: tuple[float, float] = (0.0, 50.0)
    preset: str = TUNED
    cable: bool = False

    def __post_init__(self) -> None:
        """Raises ValueError for what no cell could be built from, before anything moves."""
        for name in ("laws", "stiffnesses", "latencies"):
            if not getattr(self, name):
                raise ValueError(f"{name}: at least one is needed")
        for law in self.laws:
            law_class(law)
        for stiffness in (*self.stiffnesses, self.bottoming[1]):
            _positive("stiffness in N/mm", stiffness)
        for latency in self.latencies:
            if not (isfinite(latency) and 0.0 <= latency <= 50.0):
                raise ValueError(f"a total latency lies between 0 and 50 ms, found {latency}")
        if not (isfinite(self.bottoming[0]) and self.bottoming[0] >= 0.0):
            raise ValueError(f"a bottoming force is 0 N or more, found {self.bottoming[0]}")
        for name, value in (("force in N", self.force), ("approach in mm/s", self.approach)):
            _positive(name, value)
        _positive("push in mm/s", self.push)
        if not (isfinite(self.slide) and self.slide >= 0.0):
            raise ValueError(f"slide is 0 mm/s or more, found {self.slide}")
        if self.cable and (self.slide or self.bottoming[0]):
            raise ValueError(
                "a cable is pressed at rest, and bottoms out by itself: slide 0, no bottoming"
            )
        for variant in self.variants():
            axis_of(variant, 8_000_000)

    def variants(self) -> list[Variant]:
        """Every series, in the order of the table."""
        return [
            self.variant(law, stiffness, latency)
            for law in self.laws
            for stiffness in self.stiffnesses
            for latency in self.latencies
        ]

    def variant(self, law: str, stiffness: float, latency: float) -> Variant:
        """One series; stiffness in N/mm, latency in ms."""
        return Variant(
            law=law,
            parameters=parameters(self.preset, law),
            stiffness=stiffness * 1e3,
            latency=latency * 1e-3,
            force=self.force,
            approach=self.approach * 1e-3,
            push=self.push * 1e-3,
            slide=self.slide * 1e-3,
            bottoming_force=self.bottoming[0],
            bottoming_stiffness=self.bottoming[1] * 1e3,
            cable=self.cable,
        )


class Speeds(NamedTuple):
    """mm/s, in the order in which `Grid` takes them."""

    approach: float
    push: float
    slide: float


def speeds(
    force: float, still: bool, approach: float | None, push: float | None, slide: float | None
) -> Speeds:
    """What was chosen, and for the rest what suits the job.

    A first blow is k v theta, so the approach goes with f_d (N), up to 4 mm/s. Where the surface
    bottoms out under the tool, or a cable may buckle, any push is a first blow: it is as slow as
    the approach, and the tool keeps `still`.
    """
    down = min(4.0, 0.5 * force) if approach is None else approach
    if push is None:
        push = down if still else 16.0
    if slide is None:
        slide = 0.0 if still else 20.0
    return Speeds(down, push, slide)


def _positive(name: str, value: float) -> None:
    if not (isfinite(value) and value > 0.0):
        raise ValueError(f"{name} must be positive and finite, found {value}")
