"""Eq. 13 of the paper: the constant-gain law between force error and set-point velocity.

The paper says impedance; over a position interface the law takes force in and gives motion out,
which is admittance. Its adaptive extension (Eqs. 14, 15, 26) is not used here.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Admittance:
    """m x'' + b x' = f - f_d on one axis, x outward, f the environment's push; x_d at rest.

    mass: N s²/m. damping: N s/m. period: s. The step is implicit: explicit Euler at 8 ms with
    m = 1, b = 200 has its pole at 1 - bT/m = -0.6 and rings by itself. Against a stiffness k behind
    the arm's lag (22 Hz) and with m/b of 1 ms, b >= 0.05 s * k does not overshoot and
    b < 0.01 s * k is unstable; a larger m/b adds to the lag.
    """

    mass: float
    damping: float
    period: float

    def __post_init__(self) -> None:
        if min(self.mass, self.damping, self.period) <= 0.0:
            raise ValueError(f"mass, damping and period must be positive, found {self}")

    def velocity(self, velocity: float, force_error: float) -> float:
        """Velocity at the end of the period, m/s, from the one at its start and f - f_d in N."""
        inertia = self.mass / self.period
        return (inertia * velocity + force_error) / (inertia + self.damping)
