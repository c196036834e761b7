"""What a campaign is to compute."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from hil.campaign.errors import CampaignError
from hil.campaign.function import named
from hil.campaign.run import Json, Run
from hil.campaign.slot import Work


@dataclass(frozen=True, slots=True)
class Plan:
    """Runs of one function, `module:function`, each different; results come in their order.

    limit: wall seconds after which a run is a hang. prepare: import path of a function that is
    called with one of the runs before the first, once a worker, to load what they share.
    """

    function: str
    runs: tuple[Run, ...]
    limit: float
    prepare: str = ""

    def __post_init__(self) -> None:
        if not self.limit > 0:
            raise CampaignError(f"a run's limit is {self.limit:g} s; it must be above 0")
        if len({run.key for run in self.runs}) != len(self.runs):
            raise CampaignError("two runs of the campaign are the same: rig, variant and seed")
        for path in filter(None, (self.function, self.prepare)):
            named(path)

    @property
    def work(self) -> Work:
        return Work(self.function, self.limit, self.prepare)


def grid(
    function: str,
    rig: str,
    seeds: range,
    *,
    limit: float,
    variants: Iterable[Mapping[str, Json]] = ({},),
    prepare: str = "",
) -> Plan:
    """Every variant with every seed, on one rig."""
    runs = (Run(function, rig, seed, variant) for variant in variants for seed in seeds)
    return Plan(function, tuple(runs), limit, prepare)
