"""SOFT, the surface-observer force tracker: stand f_d/k below where the surface will be.

Not in the paper. The loop keeps one adapted number, the contact's stiffness k; one measured number,
the loop's delay theta; and one design number, the observer's bandwidth times that delay.

    x_m = command in force when f was felt, theta ago       y = x_m + f/k, the surface's place
    (s, v): alpha-beta observer of y                        x -> s + v (theta + T) - f_d/k

With kappa = k_e/k, y = kappa x_e + (1 - kappa) x. For k = k_e no feedback is left (the form of
Smith's predictor and of internal model control), so that no delay can destabilise it. Otherwise
the loop gain is |1 - kappa|, at most 1 for every k >= k_e/2: believing a contact too stiff is
always safe, which is why every touch begins at the stiffest. While that is stable, the steady
error on a surface of constant speed is zero whatever k and theta are; on a curved one it grows with
k_e, acceleration and theta squared: the price of delay.

An arm that gives way to a push stands in series with the contact: commands meet 1/k = 1/k_e + c,
while the secants of force over measured position show k_e alone. c is the arm's compliance; leaving
it out believes the contact too stiff.
"""

from dataclasses import dataclass, field
from typing import ClassVar

from controller.laws.bounds import Bounds
from controller.laws.delay import LoopDelay
from controller.laws.interface import Commanded, Felt, Reference
from controller.laws.measured import MeasuredPosition
from controller.laws.motion import MEMORY
from controller.laws.stiffness import STIFFENED, Stiffness, StiffnessSettings
from controller.laws.surface import SurfaceObserver

SLOPE = 8e-3
"""s over which the force's slope is taken when the belief in k changes."""


@dataclass(frozen=True, slots=True)
class SoftSettings:
    """Times in s, speeds in m/s.

    stiffness: the range of contacts. bandwidth: of the observer times the delay; 0.5 for more
    margin. delay, shortest, longest: theta until an approach measured it, and its range. smoothing:
    time constant of the command. surface_speed: bound of the estimate. rest: at the start, to learn
    the robot's standing offset (tare the force then too). gate: m, measured positions further from
    the command are ignored. compliance: of the arm under a push, m/N; 0 for a stiff one.
    """

    stiffness: StiffnessSettings = field(default_factory=StiffnessSettings)
    bandwidth: float = 0.75
    delay: float = 0.028
    shortest: float = 0.004
    longest: float = 0.084
    smoothing: float = 8e-3
    surface_speed: float = 0.02
    rest: float = 0.2
    gate: float = 0.01
    compliance: float = 0.0

    def __post_init__(self) -> None:
        for name in ("bandwidth", "smoothing", "surface_speed", "gate"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be positive, found {getattr(self, name)}")
        if not self.compliance >= 0.0:
            raise ValueError(f"compliance must not be negative, found {self.compliance} m/N")
        if not 0.0 < self.shortest <= self.delay <= self.longest <= MEMORY:
            raise ValueError(
                f"0 < shortest <= delay <= longest <= {MEMORY} s does not hold:"
                f" {self.shortest}, {self.delay}, {self.longest} s"
            )


class Soft:
    """The reference's speed is not needed, as the surface's own is estimated; its rate is."""

    Settings: ClassVar = SoftSettings
    __slots__ = (
        "_bounds", "_measured", "_period", "_settings", "_touched", "delay", "stiffness", "surface",
    )  # fmt: skip

    def __init__(self, settings: SoftSettings, bounds: Bounds, period: float) -> None:
        """period: s."""
        self._settings = settings
        self._bounds = bounds
        self._period = period
        self._measured = MeasuredPosition(settings.gate, round(settings.rest / period))
        self.stiffness = Stiffness(settings.stiffness, period)
        self.surface = SurfaceObserver(settings.surface_speed, period)
        self._begin()

    def reset(self, position: float) -> None:
        self._measured.reset()
        self.stiffness.reset()
        self._begin()

    def _begin(self) -> None:
        settings = self._settings
        self._touched = False
        self.delay = LoopDelay(settings.delay, settings.shortest, settings.longest, self._period)

    def velocity(self, felt: Felt, motion: Commanded, reference: Reference) -> float:
        resting = self._measured.resting
        if resting:
            self._measured.rest(felt.position, motion.position)
        measured = self._measured.over_window(felt.position, motion.position)
        if felt.touching:
            return self._follow(felt, motion, measured, reference)
        self._touched = False
        self.stiffness.lift()
        if resting:
            return 0.0
        self.delay.observe(measured, motion)
        return -self._bounds.approach

    def _follow(
        self, felt: Felt, motion: Commanded, measured: float | None, reference: Reference
    ) -> float:
        self.delay.interrupt()
        if felt.stale:
            self._touched = False
            self.stiffness.forget()
        sent = motion.ago(self.delay.value)
        self._look(felt.push, sent, sent if measured is None else measured, reference.force)
        return self._towards(motion.position, reference)

    def _look(self, push: float, sent: float, place: float, wanted: float) -> None:
        """Take this period's evidence on stiffness and surface."""
        stiffness, surface = self.stiffness, self.surface
        believed = stiffness.value
        stiffness.observe(push, place, wanted)
        seen = sent + push * self._yield()
        if not self._touched or stiffness.value > STIFFENED * believed:
            surface.start(seen)
        elif stiffness.value != believed:
            change = 1.0 / stiffness.value - 1.0 / believed
            surface.believe(push, stiffness.slope(SLOPE), change)
        surface.observe(seen, self._settings.bandwidth / self.delay.value)
        self._touched = True

    def _yield(self) -> float:
        """What a newton moves contact and arm, m/N."""
        return 1.0 / self.stiffness.value + self._settings.compliance

    def _towards(self, command: float, reference: Reference) -> float:
        """Speed to where the reference force will be, m/s."""
        period, surface, give = self._period, self.surface, self._yield()
        # One period more than the delay: the command takes effect at the end of the next.
        # Leaving it out doubled the error on a moving surface.
        target = surface.ahead(self.delay.value + period) - reference.force * give
        along = surface.speed - reference.rate * give
        return along + (target - command - along * period) / max(period, self._settings.smoothing)
