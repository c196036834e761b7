"""Eq. 13 of the paper: the constant-gain law between force error and speed."""

from dataclasses import dataclass
from typing import ClassVar

from controller.laws.bounds import Bounds
from controller.laws.interface import Commanded, Felt, Reference


@dataclass(frozen=True, slots=True)
class ConstantSettings:
    """m (N s²/m) and b (N s/m) of Eq. 13; the paper prints m = 1, b = 200."""

    mass: float = 1.0
    damping: float = 1000.0

    def __post_init__(self) -> None:
        if not min(self.mass, self.damping) > 0.0:
            raise ValueError(f"mass and damping must be positive, found {self}")


class Constant:
    """m x'' + b (x' - x_d') = f - f_d, by an implicit step.

    From print: Eq. 13 keeps x_d' but drops m x_d'', which is right only for x_d'' = 0; so here. An
    explicit Euler step at 8 ms with m = 1, b = 200 has its pole at 1 - bT/m = -0.6 and rings by
    itself; the implicit one does not, for any m, b and period.

    Against a stiffness k behind the arm's lag (22 Hz) and with m/b of 1 ms, b >= 0.05 s * k does
    not overshoot and b < 0.01 s * k is unstable; a larger m/b adds to the lag. A surface that moves
    at v leaves a steady error of b v, which no constant b makes small on soft and stiff contacts.
    """

    Settings: ClassVar = ConstantSettings
    __slots__ = ("_damping", "_inertia")

    def __init__(self, settings: ConstantSettings, bounds: Bounds, period: float) -> None:
        """period: s."""
        self._inertia = settings.mass / period
        self._damping = settings.damping

    def reset(self, position: float) -> None:
        """Nothing to forget: its state is the commanded speed."""

    def velocity(self, felt: Felt, motion: Commanded, reference: Reference) -> float:
        ahead = reference.speed
        error = felt.push - reference.force
        inertia = self._inertia
        return (inertia * (motion.speed - ahead) + error) / (inertia + self._damping) + ahead
