"""The commonly used adaptive law: damping adapted to the force error (Duan et al. 2018).

The paper compares with it as references [25-29] and prints no parameter of it.
"""

from dataclasses import dataclass
from math import inf
from typing import ClassVar

from controller.laws.bounds import Bounds
from controller.laws.interface import Commanded, Felt, Reference
from controller.laws.mass_damper import MassDamper


@dataclass(frozen=True, slots=True)
class DuanSettings:
    """mass: N s²/m. damping: N s/m. sigma: update rate, share of e/b added per `cycle` (s).

    limit: of the adapted speed, m/s. freeze: no adaptation in free air.
    """

    mass: float = 1.0
    damping: float = 200.0
    sigma: float = 0.01
    cycle: float = 8e-3
    limit: float = inf
    freeze: bool = True

    def __post_init__(self) -> None:
        if not min(self.mass, self.damping, self.cycle, self.limit) > 0.0 or not self.sigma >= 0.0:
            raise ValueError(f"all but sigma must be positive, sigma not negative, found {self}")


class Duan:
    """m x'' + (b + db) x' = f - f_d with db = b Phi / x' and Phi += sigma (f - f_d) / b.

    The adapted damping times the speed is b Phi, so that Phi is a speed and the law an integral of
    the force error: v = (f - f_d)/b + Phi. Departures from print, each with its reason:

    * with x along the outward normal and the error f - f_d, the adapted term enters as b - db; the
      published sign pushes the wrong way;
    * db is never formed: x' passes through zero at every steady contact;
    * sigma is per `cycle`, 8 ms, and not per control period, or the same number would integrate
      four times as fast at 500 Hz; `cycle` equal to the period is the law as printed;
    * Phi is frozen in free air, where the error is constant and it would wind up. `freeze=False`
      is the law as printed.
    """

    Settings: ClassVar = DuanSettings
    __slots__ = ("_gain", "_mass", "_settings", "adapted")

    def __init__(self, settings: DuanSettings, bounds: Bounds, period: float) -> None:
        """period: s."""
        self._settings = settings
        self._mass = MassDamper(settings.mass, settings.damping, period)
        self._gain = settings.sigma * period / (settings.cycle * settings.damping)
        self.adapted = 0.0

    def reset(self, position: float) -> None:
        self.adapted = 0.0

    def velocity(self, felt: Felt, motion: Commanded, reference: Reference) -> float:
        settings = self._settings
        error = felt.push - reference.force
        if felt.touching or not settings.freeze:
            adapted = self.adapted + self._gain * error
            self.adapted = min(max(adapted, -settings.limit), settings.limit)
        wanted = error / settings.damping + self.adapted + reference.speed
        return self._mass.after(motion.speed, wanted)
