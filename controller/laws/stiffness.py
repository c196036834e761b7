"""The contact's stiffness as secants of force over position show it, erring on the stiff side."""

from collections import deque
from dataclasses import dataclass
from itertools import islice

LONGEST_PATIENCE = 30.0
"""s: where doubling ends."""
STIFFENED = 1.5
"""Factor from which a stiffer reading is another contact and not the same one seen better."""


@dataclass(frozen=True, slots=True)
class StiffnessSettings:
    """Stiffness in N/m, force in N, position in m, times in s.

    softest, stiffest: range; every touch starts at `stiffest`. margin: estimate over secant. share:
    step of the logarithm towards a secant, per period. loud, resolution: changes of force and
    position that a secant needs (25 sigma of a period's mean, 4 sigma of the arm's reading). look:
    how far back. blow: a secant this short may also stiffen. patience: without softening after a
    blow, doubled at each.
    """

    softest: float = 1e3
    stiffest: float = 50e3
    margin: float = 1.15
    share: float = 0.3
    loud: float = 0.5
    resolution: float = 20e-6
    look: float = 0.5
    blow: float = 0.024
    patience: float = 1.0

    def __post_init__(self) -> None:
        if not 0.0 < self.softest < self.stiffest:
            raise ValueError(
                f"0 < softest < stiffest does not hold: {self.softest}, {self.stiffest} N/m"
            )
        for name in ("margin", "share", "loud", "resolution", "look", "blow", "patience"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be positive, found {getattr(self, name)}")


class Stiffness:
    """Too stiff is always safe, too soft by more than half is not: so it falls only while loading,
    and rises at once when the force jumps.
    """

    __slots__ = (
        "_blow", "_forces", "_hold", "_loading", "_patience", "_period", "_places", "_settings",
        "value",
    )  # fmt: skip

    def __init__(self, settings: StiffnessSettings, period: float) -> None:
        self._settings = settings
        self._period = period
        self._blow = max(1, round(settings.blow / period))
        length = round(settings.look / period) + 1
        self._forces: deque[float] = deque(maxlen=length)
        self._places: deque[float] = deque(maxlen=length)
        self.reset()

    def reset(self) -> None:
        """Forget the past, patience too."""
        self._hold = 0.0
        self._patience = self._settings.patience
        self.lift()

    def lift(self) -> None:
        """Nothing is touched: what comes next may be as stiff as it can be."""
        self.forget()
        self.value = self._settings.stiffest
        self._loading = True

    def forget(self) -> None:
        """Drop the window, keep the value: readings were missing."""
        self._forces.clear()
        self._places.clear()

    def slope(self, span: float) -> float:
        """Rate of the force over the last `span` seconds, N/s."""
        forces = self._forces
        back = min(max(1, round(span / self._period)), len(forces) - 1)
        return (forces[-1] - forces[-1 - back]) / (back * self._period)

    def observe(self, force: float, place: float, wanted: float) -> None:
        """One period in contact: mean push and the reference (N), robot position (m)."""
        self._judge_phase(abs(force - wanted), wanted)
        forces = self._forces
        if forces:
            self._hold = max(0.0, self._hold - self._period)
            loud = self._settings.loud
            # Only while it may soften does more than the last few count; quiet contact, the usual
            # case, is told apart at C speed.
            softening = self._loading and self._hold <= 0.0
            recent = forces if softening else tuple(islice(reversed(forces), self._blow))
            if max(recent) - force >= loud or force - min(recent) >= loud:
                self._search(force, place, len(recent))
        forces.append(force)
        self._places.append(place)

    def _judge_phase(self, error: float, wanted: float) -> None:
        """Loading until the error was once small, again when it gets large."""
        if error < 0.1 * wanted:
            self._loading = False
        elif error > 0.5 * wanted:
            self._loading = True

    def _search(self, force: float, place: float, reach: int) -> None:
        """Use the shortest look back over which force and position both changed audibly.

        reach: periods.
        """
        loud, resolution = self._settings.loud, self._settings.resolution
        past = zip(reversed(self._forces), reversed(self._places), strict=True)
        for back, (before, there) in enumerate(islice(past, reach), start=1):
            rise, way = force - before, place - there
            if -loud < rise < loud:
                continue
            quick = back <= self._blow
            if quick and rise > 0.0 > way and self._struck(rise, -way):
                return
            if abs(way) >= resolution:
                if rise * way < 0.0:
                    self._lean(-rise / way, quick)
                return

    def _struck(self, rise: float, way: float) -> bool:
        """Believe a blow at once: something stiffer was touched."""
        settings = self._settings
        secant = settings.margin * rise / max(way, settings.resolution)
        if self.value >= settings.stiffest or secant <= STIFFENED * self.value:
            return False
        self.value = min(secant, settings.stiffest)
        self._hold = self._patience
        self._patience = min(2.0 * self._patience, LONGEST_PATIENCE)
        return True

    def _lean(self, secant: float, quick: bool) -> None:
        """Towards a secant: up only on a short one, down only while loading and after patience."""
        settings = self._settings
        ratio = settings.margin * secant / self.value
        if quick if ratio > 1.0 else self._loading and self._hold <= 0.0:
            value = self.value * float(ratio**settings.share)
            self.value = min(max(value, settings.softest), settings.stiffest)
