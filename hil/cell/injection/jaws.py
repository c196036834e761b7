"""Jaws that do not do what their output says."""

from typing import Final

from hil.cell.arm.jaws import DelayedSwitch, Jaws
from hil.cell.faults.injector import Running
from hil.cell.injection.injection import Injection
from hil.cell.rig.robot import Jaws as JawsSection

NS: Final = 1_000_000_000


class InjectedJaws(Jaws):
    """`dead` stay as they are; `half` jaws neither take nor give, and sense nothing; `late` ones
    follow after the fault's delay.
    """

    def __init__(self, section: JawsSection, injection: Injection) -> None:
        super().__init__(section)
        self._injection = injection
        self._late: dict[int, DelayedSwitch] = {}

    def drive(self, outputs: int, t: int) -> bool:
        for one in self._injection.of("G2"):
            wanted = bool(outputs >> self.output & 1)
            follows = self._follows(one, wanted, t)
            if follows != wanted:
                one.felt(t, f"jaws {one.fault.word('what')}")
            outputs = outputs & ~(1 << self.output) | follows << self.output
        return super().drive(outputs, t)

    def sense(self, part_held: bool, t: int) -> bool:
        half = any(one.fault.word("what") == "half" for one in self._injection.of("G2"))
        return super().sense(part_held and not half, t)

    def _follows(self, one: Running, wanted: bool, t: int) -> bool:
        if one.fault.word("what") != "late":
            return self.closed
        switch = self._late.get(one.index)
        if switch is None:
            delay = one.fault.number("delay")
            switch = self._late[one.index] = DelayedSwitch(delay, delay)
            switch.on = self.closed
        return switch.update(wanted, t)
