"""The paper's adaptive law: Eqs. 14, 15 and 26 in the one form in which they agree."""

from dataclasses import dataclass, field
from enum import Enum
from math import inf
from typing import ClassVar

from controller.laws.adaptation import Adaptation, AdaptationSettings
from controller.laws.bounds import Bounds
from controller.laws.filtered import FilteredForce
from controller.laws.interface import Commanded, Felt, Reference
from controller.laws.mass_damper import MassDamper


@dataclass(frozen=True, slots=True)
class PaperSettings:
    """mass: N s²/m. damping: N s/m. cutoff: of force and its rate, Hz; 10 to 20 at
    125 Hz, 40 at 500 Hz.

    The defaults are the printed numbers read in millimetres, bounded: stable up to 3 N/mm.
    """

    mass: float = 1.0
    damping: float = 200.0
    cutoff: float = 10.0
    adaptation: AdaptationSettings = field(default_factory=AdaptationSettings)


class Reading(Enum):
    """Which length the printed gains are meant in; the paper gives no unit."""

    METRES = 1.0
    MILLIMETRES = 1e-3


def as_printed(reading: Reading, p2: float, p3_over_p2: float = 0.1) -> PaperSettings:
    """The paper's numbers without any of the additions: no bounds, no leak, no freeze.

    p2 and p3 are not printed. In metres every p2 from 1e-4 to 1 is unstable from 1 N/mm on; in
    millimetres p2 = 0.01 holds to 3 N/mm, with the adaptation then close to nothing.
    """
    u = reading.value
    adaptation = AdaptationSettings(
        p2, p3_over_p2 * p2, 0.09 * u, 0.1 * u, 0.4 * u, 1.5 * u, 0.3 * u, 0.4 * u, 0.1 * u,
        0.1 * u, 0.1 * u, inf, inf, inf, dead_zone=0.0, leak=0.0, freeze=False,
    )  # fmt: skip
    return PaperSettings(adaptation=adaptation)


class PaperAic:
    """m x'' + b (x' - x_d') = df, x_d' = phi + lambda_p df + lambda_d df', df = f - f_d.

    Departures from print, each with its reason:

    * Eq. 11 has +f_d inside the bracket; with df = f - f_d it is -f_d, as Eq. 12 has it;
    * Eqs. 16 to 25 lose the factor b k_e of lambda_p and lambda_d, swap the two in Eqs. 17, 19 and
      21, and invert mu in Eq. 25. Eq. 26 is right as a law, since its mu and rho absorb k_e, and is
      what runs here; `lyapunov` has the function of Eqs. 20 and 23 that fits it;
    * df' is filtered, as a difference of raw samples would be noise, and holds f_d' too;
    * the mass is integrated exactly (`MassDamper`);
    * bounds, dead zone, leak and freeze: see `Adaptation`; `as_printed` is the law without them.
    """

    Settings: ClassVar = PaperSettings
    __slots__ = ("_adaptation", "_damping", "_force", "_mass")

    def __init__(self, settings: PaperSettings, bounds: Bounds, period: float) -> None:
        """period: s."""
        self._mass = MassDamper(settings.mass, settings.damping, period)
        self._damping = settings.damping
        self._force = FilteredForce(settings.cutoff, period)
        self._adaptation = Adaptation(settings.adaptation, period)

    def reset(self, position: float) -> None:
        self._force.reset()
        self._adaptation.reset()

    def velocity(self, felt: Felt, motion: Commanded, reference: Reference) -> float:
        force = self._force
        force.feed(felt.samples)
        error, rate = force.force - reference.force, force.rate - reference.rate
        phi, proportional, derivative = self._adaptation.gains(error, rate, felt.touching)
        wanted = phi + proportional * error + derivative * rate + error / self._damping
        return self._mass.after(motion.speed, wanted + reference.speed)
