"""The control box and its arm, with faults: stops, limits, wrong commands, wrong poses."""

from collections.abc import Mapping
from math import hypot, nan
from typing import Final

import numpy as np

from drivers.protocol.rtde_states import RobotMode, RuntimeState, SafetyMode
from hil.cell.arm.controller import ArmController, ArmTarget
from hil.cell.arm.modes import Event
from hil.cell.arm.pose import Pose, Vector6
from hil.cell.arm.registers import BITS, COUNT
from hil.cell.faults.injector import Running
from hil.cell.geometry import turn_about_z
from hil.cell.injection.injection import Act, Injection, Switch
from hil.cell.rig.robot import Robot

NS: Final = 1_000_000_000
G: Final = 9.81
STOP_TIME: Final = 500_000_000
"""Between the controlled stop and power off of a category 1 stop, ns (assumed)."""
_X, _Y, _Z = (f"input_double_register_{n}" for n in (24, 25, 26))
"""Where the near side's program takes its set-point from."""


class InjectedArm(ArmController):
    """Commands, poses and forces pass through here on their way in and out."""

    def __init__(self, robot: Robot, rng: np.random.Generator, injection: Injection) -> None:
        super().__init__(robot, rng)
        self._injection = injection
        injection.add(*acts(injection, self))

    def accept(self, values: Mapping[str, object], arrival: int) -> None:
        for one in self._injection.of("R7"):
            if _X in values:
                values = _spoilt(one, values)
                one.felt(self.box.t, f"set-point {one.fault.word('value')}")
        super().accept(values, arrival)

    def frame(self, t: int) -> ArmTarget:
        target = super().frame(t)
        for one in self._off():
            target = target._replace(flange=_moved(one, target.flange, 1))
            one.felt(t, "poses off")
        return target

    def observe(
        self, t: int, flange: Pose, twist: Vector6, force: Vector6, part_held: bool
    ) -> None:
        for one in reversed(self._off()):
            flange = _moved(one, flange, -1)
        for one in self._injection.of("R8"):
            fx, fy, fz, tx, ty, tz = force
            force = (fx, fy, fz - one.fault.number("mass") * G, tx, ty, tz)
        super().observe(t, flange, twist, force, part_held)

    def restart(self) -> None:
        """As after a power cut: no power, no program, registers and outputs zero."""
        box = self.box
        self.programs.stop()
        box.post(Event.POWER_OFF)
        box.signals.outputs = 0
        for bank in (box.registers.inputs, box.registers.outputs):
            bank.integers[:], bank.floats[:] = [0] * COUNT, [0.0] * COUNT
            bank.booleans[:] = [False] * BITS
        box.say("controller restarted")

    def _off(self) -> tuple[Running, ...]:
        return self._injection.of("R8") + self._injection.of("R9")


def _moved(one: Running, pose: Pose, sign: int) -> Pose:
    """Where the flange truly is when the box believes `pose`; sign -1 is the way back."""
    fault = one.fault
    if fault.kind == "R8":
        x, y, z = pose.position
        return Pose((x, y, z - sign * fault.number("tcp")), pose.rotation)
    dx, dy, dz = (sign * fault.number(name) for name in ("dx", "dy", "dz"))
    x, y, z = pose.position
    turned = turn_about_z(sign * fault.number("rotation"), pose.rotation)
    return Pose((x + dx, y + dy, z + dz), turned)


def _spoilt(one: Running, values: Mapping[str, object]) -> Mapping[str, object]:
    if one.fault.word("value") == "nan":
        return {**values, _X: nan, _Y: nan, _Z: nan}
    height = values[_Z]
    assert isinstance(height, float), "a set-point is numbers"
    return {**values, _Z: height + one.fault.number("jump")}


def acts(injection: Injection, arm: InjectedArm) -> tuple[Act, ...]:
    """Everything that is done to the box itself."""
    box = arm.box
    before = box.robot

    def limits(**changed: float) -> None:
        safety = box.robot.safety.model_copy(update=changed)
        box.robot = box.robot.model_copy(update={"safety": safety})

    def restore() -> None:
        box.robot = before

    def slow(one: Running, _: int) -> None:
        if one.fault.word("what") == "speed":
            limits(tcp_speed=one.fault.number("speed"))

    def scale(one: Running, t: int) -> None:
        box.signals.speed_fraction = one.fault.number("factor")
        one.felt(t, f"speed scaling {box.signals.speed_fraction:g}")

    def unscaled() -> None:
        box.signals.speed_fraction = 1.0

    def payload(one: Running, t: int) -> None:
        one.felt(t, f"{one.fault.number('mass'):g} kg")

    return (
        Switch(injection, "R4", scale, unscaled),
        Switch(injection, "R6", slow, restore),
        Switch(injection, "R8", payload),
        Stops(injection, arm),
    )


class Stops:
    """Stops of every kind, and the limits that lead to one."""

    def __init__(self, injection: Injection, arm: InjectedArm) -> None:
        self._injection, self._arm = injection, arm
        self._planes: dict[int, float] = {}
        self._limits: dict[int, tuple[float, ...]] = {}

    def before(self, t: int) -> None:
        box = self._arm.box
        for one in self._injection.of("R1"):
            if box.modes.moving:
                box.protective_stop("injected")
                one.done(t, "protective stop")
        for one in self._injection.of("R2"):
            self._emergency(one, t)
        for one in self._injection.of("R3"):
            self._program(one, t)
        for one in self._injection.of("R5"):
            if (reason := self._outside(one)) and box.modes.moving:
                box.protective_stop(reason)
                one.felt(t, reason)
        for one in self._injection.of("R6"):
            if (reason := self._beyond(one)) and box.modes.moving:
                box.protective_stop(reason)
                one.felt(t, reason)

    def after(self, t: int) -> None:
        """A limit has had its effect when the safety system stopped for it."""
        if self._arm.box.modes.safety is SafetyMode.PROTECTIVE_STOP:
            for one in self._injection.of("R6"):
                one.felt(t, "the safety system stopped the arm")

    def _emergency(self, one: Running, t: int) -> None:
        box = self._arm.box
        if one.fault.word("category") == "1" and t < one.since + STOP_TIME:
            if one.effect is None:
                box.protective_stop("emergency stop, category 1")
                one.felt(t, "controlled stop")
        elif box.modes.robot is not RobotMode.POWER_OFF and box.post(Event.EMERGENCY_STOP):
            box.say("emergency stop")
            one.done(t, "power off")

    def _program(self, one: Running, t: int) -> None:
        """Once a program plays: it is stopped, or paused for as long as the fault lasts."""
        box = self._arm.box
        if one.fault.word("what") == "stop":
            if one.effect is None and box.modes.program is RuntimeState.PLAYING:
                self._arm.programs.stop()
                one.done(t, "program stopped")
        elif t + box.period >= one.until:
            box.post(Event.RESUME)
        elif box.post(Event.PAUSE):
            one.felt(t, "program paused")

    def _outside(self, one: Running) -> str:
        """Why the arm may not stand there: each joint's limit is `margin` beyond where it stood."""
        q, margin = self._arm.box.servo.q, one.fault.number("margin")
        limits = self._limits.setdefault(one.index, tuple(abs(angle) + margin for angle in q))
        for joint, (angle, limit) in enumerate(zip(q, limits, strict=True)):
            if abs(angle) > limit + 1e-6:
                return f"joint {joint} at {angle:.4f} rad, allowed is {limit:.4f} rad"
        return ""

    def _beyond(self, one: Running) -> str:
        box, fault = self._arm.box, one.fault
        what = fault.word("what")
        if what == "force":
            force = hypot(*box.measured.force[:3])
            return f"force {force:.3g} N" if force > fault.number("force") else ""
        if what == "plane":
            height = box.tool.tip(box.target.flange)[2]
            plane = self._planes.setdefault(one.index, height - fault.number("height"))
            return f"safety plane: {height:.4g} m is below {plane:.4g} m" if height < plane else ""
        return ""
