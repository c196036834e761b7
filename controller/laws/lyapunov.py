"""The Lyapunov function behind Eq. 26, corrected, for the ideal loop it is a statement about.

Ideal means: no robot lag, no delay, a two-sided linear spring at rest, always in contact, exact
df', continuous time. A moving surface or a real arm is outside it, and there V may rise.
"""

from dataclasses import dataclass
from typing import NamedTuple


class LoopState(NamedTuple):
    """df (N), df' (N/s), and the integrals in phi, lambda_p and lambda_d."""

    error: float
    rate: float
    phi: float
    proportional: float
    derivative: float


@dataclass(frozen=True, slots=True)
class IdealLoop:
    """Eqs. 14, 15, 26 on a spring k_e, and the model s² + 2 eta w s + w² of Eq. 18.

    mass: N s²/m. damping: N s/m. stiffness: N/m. omega: rad/s. q1, q2: of Q. mu, rho: of Eq. 26,
    positive. V weighs errors of phi, lambda_p, lambda_d; Eq. 23 is semidefinite in them: df goes to
    zero (Barbalat), the gains need not converge.
    """

    mass: float
    damping: float
    stiffness: float
    omega: float
    eta: float
    q1: float
    q2: float
    mu: tuple[float, float, float]
    rho: tuple[float, float, float]

    @property
    def p2(self) -> float:
        """P R + R'P = -diag(q1, q2), not Eq. 21's Q, which names a D that is nowhere defined."""
        return self.q1 / (2.0 * self.omega**2)

    @property
    def p3(self) -> float:
        """More than p2 / (2 eta w) for any q2: delta is then strictly positive real."""
        return (self.q2 + 2.0 * self.p2) / (4.0 * self.eta * self.omega)

    @property
    def p1(self) -> float:
        return 2.0 * self.eta * self.omega * self.p2 + self.omega**2 * self.p3

    @property
    def gain(self) -> float:
        """B k_e / m, which Eq. 16 keeps for phi and drops for lambda_p and lambda_d."""
        return self.damping * self.stiffness / self.mass

    def delta(self, state: LoopState) -> float:
        """Eq. 22's p2 df + p3 df'."""
        return self.p2 * state.error + self.p3 * state.rate

    def flow(self, state: LoopState, surface_speed: float = 0.0) -> LoopState:
        """Time derivative of the state; Eq. 16 with b k_e lambda_p, b k_e lambda_d kept."""
        delta, (mu0, mu1, mu2), (r0, r1, r2) = self.delta(state), self.mu, self.rho
        phi = state.phi + r0 * delta
        a0, a1 = self._coefficients(state, r1 * delta * state.error, r2 * delta * state.rate)
        bend = -a1 * state.rate - a0 * state.error - self.gain * (phi - surface_speed)
        return LoopState(
            state.rate, bend, mu0 * delta, mu1 * delta * state.error, mu2 * delta * state.rate
        )

    def value(self, state: LoopState) -> float:
        """V of Eq. 20 with the squares of phi*, lambda_p*, lambda_d* (the integrals' errors).

        Their weights are m / (b k_e mu): Eq. 25 prints mu1 / m and mu2 / m, which inverts mu.
        """
        a0, a1 = self._coefficients(state, 0.0, 0.0)
        w, gain = self.omega, self.gain
        errors = (gain * state.phi, a0 - w * w, a1 - 2.0 * self.eta * w)
        adapted = sum(e * e / (gain * mu) for e, mu in zip(errors, self.mu, strict=True))
        e, d = state.error, state.rate
        return self.p1 * e * e + 2.0 * self.p2 * e * d + self.p3 * d * d + adapted

    def slope(self, state: LoopState) -> float:
        """V' along the flow at a surface at rest, Eq. 23 with beta* = b k_e rho / m; never > 0."""
        delta = self.delta(state)
        e, d = state.error, state.rate
        damped = self.rho[0] + self.rho[1] * e * e + self.rho[2] * d * d
        return -self.q1 * e * e - self.q2 * d * d - 2.0 * self.gain * delta * delta * damped

    def _coefficients(
        self, state: LoopState, proportional: float, derivative: float
    ) -> tuple[float, float]:
        """a0, a1 of df'' + a1 df' + a0 df; Eqs. 17 and 19 have lambda_p and lambda_d swapped."""
        a0 = self.stiffness / self.mass + self.gain * (state.proportional + proportional)
        a1 = self.damping / self.mass + self.gain * (state.derivative + derivative)
        return a0, a1
