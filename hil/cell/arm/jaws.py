"""Pneumatic jaws: valve delay on the way in, sensor delay on the way out."""

from hil.cell.rig.robot import Jaws as JawsSection

NS = 1_000_000_000


class DelayedSwitch:
    """A two-state device that follows its input late; one taken back in time has no effect."""

    __slots__ = ("_due", "_fall", "_rise", "on")

    def __init__(self, rise: float, fall: float) -> None:
        """rise, fall: delays of switching on and off, s."""
        self._rise = round(rise * NS)
        self._fall = round(fall * NS)
        self._due: int | None = None
        self.on = False

    def update(self, wanted: bool, t: int) -> bool:
        """The state at bench time t, ns, with the input at `wanted` from t on."""
        if wanted == self.on:
            self._due = None
        elif self._due is None:
            self._due = t + (self._rise if wanted else self._fall)
        if self._due is not None and t >= self._due:
            self.on, self._due = wanted, None
        return self.on


class Jaws:
    """closed: jaws' true position. sensed: the grip sensor says that a part is held."""

    __slots__ = ("_position", "_sensor", "output", "sensed_input")

    def __init__(self, section: JawsSection) -> None:
        self.output = section.output
        self.sensed_input = section.sensed
        self._position = DelayedSwitch(section.close_delay, section.open_delay)
        self._sensor = DelayedSwitch(section.sense_delay, section.sense_delay)

    @property
    def closed(self) -> bool:
        return self._position.on

    def drive(self, outputs: int, t: int) -> bool:
        """Take the digital outputs at t; true in the cycle in which the jaws come to close."""
        was_closed = self._position.on
        return self._position.update(bool(outputs >> self.output & 1), t) and not was_closed

    def sense(self, part_held: bool, t: int) -> bool:
        """What the grip sensor says at t, given the truth."""
        return self._sensor.update(part_held, t)
