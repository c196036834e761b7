"""Eq. 14's left side: a mass and a damper follow a reference speed, exactly over one period."""

from math import exp


class MassDamper:
    """m x'' + b (x' - v) = 0 for a constant v. mass: N s²/m. damping: N s/m. period: s.

    The exact solution: explicit Euler has its pole at 1 - bT/m, which is -0.6 at the printed m = 1,
    b = 200 and 8 ms.
    """

    __slots__ = ("_decay",)

    def __init__(self, mass: float, damping: float, period: float) -> None:
        if not min(mass, damping) > 0.0:
            raise ValueError(f"mass and damping must be positive, found {mass} and {damping}")
        self._decay = exp(-damping * period / mass)

    def after(self, speed: float, reference: float) -> float:
        """Speed one period on, m/s."""
        return self._decay * speed + (1.0 - self._decay) * reference
