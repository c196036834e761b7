"""One cell of the experiment's grid, and the rig and the law it is run on."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields

from controller.laws.bounds import Bounds
from controller.laws.build import Parameters, build, settings_of
from controller.laws.governor import Governor
from controller.reference import Slide, Step
from controller.track import Tracking
from hil.campaign.run import Json
from hil.cell.rig import Rig
from hil.cell.rig.latency import LatencyLaw


@dataclass(frozen=True, slots=True)
class Variant:
    """What distinguishes one series of runs from another.

    stiffness: k_e, N/m. latency: of sensor and command together, mean, s. force: f_d, N.
    bottoming_force: push (N) at which the surface turns as stiff as `bottoming_stiffness` (N/m).
    approach, push: inward speeds in free air and in contact, m/s. slide: along the surface after
    the hold, m/s; 0 ends the run with the hold. parameters: of the law.
    cable: press a gripped cable on the connector's face; `stiffness` is then but a name.
    nominal: the rig's own surface, or cable, instead of a drawn one. trace: keep the time courses.
    recording: folder for the run's recording, "" for none.
    """

    law: str
    parameters: Parameters
    stiffness: float = 10e3
    latency: float = 6e-3
    force: float = 10.0
    approach: float = 4e-3
    push: float = 16e-3
    slide: float = 20e-3
    bottoming_force: float = 0.0
    bottoming_stiffness: float = 50e3
    cable: bool = False
    nominal: bool = False
    trace: bool = False
    recording: str = ""

    def as_json(self) -> dict[str, Json]:
        """As a campaign passes it on."""
        return asdict(self)

    @classmethod
    def from_json(cls, content: Mapping[str, Json]) -> "Variant":
        known = {field.name for field in fields(cls)}
        return cls(**{key: value for key, value in content.items() if key in known})  # type: ignore[arg-type]


def rig_of(rig: Rig, variant: Variant) -> Rig:
    """The rig with this variant's surface and delays, half of them on either wire."""
    surface = {
        "stiffness": variant.stiffness,
        "bottoming_force": variant.bottoming_force,
        "bottoming_stiffness": variant.bottoming_stiffness,
    }
    latency = rig.latency
    rtde = latency.rtde.model_copy(
        update={"to_cell": with_mean(latency.rtde.to_cell, variant.latency / 2)}
    )
    can = latency.can.model_copy(
        update={"from_cell": with_mean(latency.can.from_cell, variant.latency / 2)}
    )
    drawn = (rig.randomisation.enabled or variant.cable) and not variant.nominal
    return rig.model_copy(
        update={
            "randomisation": rig.randomisation.model_copy(update={"enabled": drawn}),
            "surface": rig.surface.model_copy(update=surface),
            "latency": latency.model_copy(update={"rtde": rtde, "can": can}),
        }
    )


def with_mean(law: LatencyLaw, mean: float) -> LatencyLaw:
    """The law with another mean, s; without a mean there is no jitter either."""
    if mean <= 0.0:
        return LatencyLaw()
    return law.model_copy(update={"mean": mean})


def job_of(variant: Variant) -> Tracking:
    """What the arm does: down, hold, slide."""
    force = Step(variant.force)
    if variant.slide == 0.0:
        return Tracking(force=force, moving=0.0)
    return Tracking(force=force, slide=Slide(variant.slide))


def bounds_of(variant: Variant) -> Bounds:
    """What every law may do here. The force stop is far off: an unstable law shall show it."""
    return Bounds(approach=variant.approach, push=variant.push, stop=5.0 * variant.force)


def axis_of(variant: Variant, period: int) -> Governor:
    """The variant's law on one axis; ValueError for a law or parameters that do not exist."""
    settings = settings_of(variant.law, variant.parameters)
    bounds = bounds_of(variant)
    bounds.check(variant.force)
    return build(variant.law, settings, bounds, period)
