"""Where the surface is and how fast it moves, from the force it answers with."""

from math import exp


class SurfaceObserver:
    """An alpha-beta observer of the surface's place (m) and speed (m/s), both poles at one place.

    Its speed is bounded by `fastest`, m/s. period: s.
    """

    __slots__ = ("_fastest", "_period", "place", "speed")

    def __init__(self, fastest: float, period: float) -> None:
        self._fastest = fastest
        self._period = period
        self.place = 0.0
        self.speed = 0.0

    def start(self, place: float) -> None:
        """Begin anew with a surface at rest here, m."""
        self.place, self.speed = place, 0.0

    def believe(self, force: float, slope: float, compliance: float) -> None:
        """The same evidence under another stiffness: place and speed as if it had always been so.

        force: N. slope: its rate, N/s. compliance: change of 1/k, m/N.
        """
        self.place += force * compliance
        self.speed += slope * compliance

    def observe(self, place: float, bandwidth: float) -> None:
        """One period on, and the surface was seen here, m. bandwidth: rad/s."""
        pole = exp(-bandwidth * self._period)
        predicted = self.place + self.speed * self._period
        residual = place - predicted
        self.place = predicted + (1.0 - pole * pole) * residual
        speed = self.speed + (1.0 - pole) ** 2 * residual / self._period
        self.speed = min(max(speed, -self._fastest), self._fastest)

    def ahead(self, delay: float) -> float:
        """Where it will be so many seconds from now, m."""
        return self.place + self.speed * delay
