"""Eq. 26 of the paper: the three gains that adapt to the force error."""

from dataclasses import dataclass
from math import inf
from typing import NamedTuple


class Gains(NamedTuple):
    """phi: m/s. proportional: lambda_p, m/(N s). derivative: lambda_d, m/N."""

    phi: float
    proportional: float
    derivative: float


@dataclass(frozen=True, slots=True)
class AdaptationSettings:
    """Eq. 26 with delta = p2 df + p3 df' in newtons: p2 is a number and p3 in s.

    phi0: m/s; lp0: m/(N s); ld0: m/N. mu0: m/(N s²); rho0: m/(N s). mu1: m/(N³ s²); rho1:
    m/(N³ s). mu2: m/N³; rho2: m s/N³. phi_max, lp_max, ld_max: bounds in the units of the gains.
    dead_zone: |df| below which lambda_p and lambda_d rest, N. leak: 1/s.
    """

    p2: float = 0.01
    p3: float = 0.001
    phi0: float = 0.09e-3
    lp0: float = 0.1e-3
    ld0: float = 0.4e-3
    mu0: float = 1.5e-3
    rho0: float = 0.3e-3
    mu1: float = 0.4e-3
    rho1: float = 0.1e-3
    mu2: float = 0.1e-3
    rho2: float = 0.1e-3
    phi_max: float = 4e-3
    lp_max: float = 1e-3
    ld_max: float = 0.5e-3
    dead_zone: float = 0.054
    leak: float = 0.0
    freeze: bool = True

    def __post_init__(self) -> None:
        if not self.p2 > 0.0 or not self.p3 >= 0.0:
            raise ValueError(f"p2 > 0 and p3 >= 0 does not hold: {self.p2}, {self.p3}")
        for name in ("mu0", "mu1", "mu2", "rho0", "rho1", "rho2", "dead_zone", "leak"):
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} must not be negative, found {getattr(self, name)}")
        for name, start in (("phi", self.phi0), ("lp", self.lp0), ("ld", self.ld0)):
            if not abs(start) <= getattr(self, name + "_max"):
                raise ValueError(f"{name}0 = {start} lies beyond {name}_max")


class Adaptation:
    """The three integrals of Eq. 26, and the gains they give. period: s.

    As derived, lambda_p' and lambda_d' hold the squares mu1 p2 df² and mu2 p3 df'², so that noise
    and tracking error only ever raise them until the loop oscillates, and in free air, where df is
    constant, phi and lambda_p wind up. Hence three additions: bounds, a dead zone with a leak
    (sigma modification), and a freeze in free air.
    """

    __slots__ = ("_ld", "_lp", "_period", "_phi", "_settings")

    def __init__(self, settings: AdaptationSettings, period: float) -> None:
        self._settings = settings
        self._period = period
        self.reset()

    def reset(self) -> None:
        self._phi = self._lp = self._ld = 0.0

    def gains(self, error: float, rate: float, touching: bool) -> Gains:
        """One period on, with df (N) and df' (N/s)."""
        c = self._settings
        delta = c.p2 * error + c.p3 * rate
        if touching or not c.freeze:
            self._integrate(delta, error, rate)
        return Gains(
            c.phi0 + self._phi + c.rho0 * delta,
            _within(c.lp0 + self._lp + c.rho1 * delta * error, c.lp_max),
            _within(c.ld0 + self._ld + c.rho2 * delta * rate, c.ld_max),
        )

    def _integrate(self, delta: float, error: float, rate: float) -> None:
        c, period = self._settings, self._period
        self._phi += c.mu0 * delta * period
        self._phi = min(max(self._phi, -c.phi_max), c.phi_max)
        loud = 0.0 if abs(error) < c.dead_zone else period
        keep = 1.0 - c.leak * period
        lp = keep * self._lp + c.mu1 * delta * error * loud
        ld = keep * self._ld + c.mu2 * delta * rate * loud
        # Held where the gain they make stays between zero and its bound: no wind-up beyond it.
        self._lp = _held(lp, c.lp0, c.lp_max)
        self._ld = _held(ld, c.ld0, c.ld_max)


def _within(gain: float, most: float) -> float:
    return gain if most == inf else min(max(gain, 0.0), most)


def _held(integral: float, start: float, most: float) -> float:
    return integral if most == inf else min(max(integral, -start), most - start)
