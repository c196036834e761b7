"""The arm's control loop: one cycle turns inputs, program and limits into the plant's target."""

from collections.abc import Mapping
from math import hypot
from typing import NamedTuple

import numpy as np

from hil.cell.arm.box import NS, ControlBox
from hil.cell.arm.force.estimate import BUILT_IN, CURRENTS
from hil.cell.arm.modes import Event
from hil.cell.arm.pose import Pose, Vector6, compose
from hil.cell.arm.programs import Programs
from hil.cell.arm.repeatability import Repeatability
from hil.cell.arm.safety import ForceGuard, Motion, judge
from hil.cell.arm.script_port import ScriptPort
from hil.cell.arm.servo import STOP_DECELERATION
from hil.cell.arm.watchdog import Action
from hil.cell.rig.robot import Robot


class ArmTarget(NamedTuple):
    """What the plant shall follow in this cycle.

    q: joint target, rad. flange: where the flange truly goes in the base frame, the hidden
    repeatability error included. jaws_closed: the jaws' true position.
    """

    q: Vector6
    flange: Pose
    jaws_closed: bool


class ArmController:
    """An emulated control box with its arm; `frame` and `observe` once a period, in turn."""

    __slots__ = ("_dt", "_force", "_repeatability", "box", "port", "programs")

    def __init__(self, robot: Robot, rng: np.random.Generator) -> None:
        self.box = ControlBox(robot)
        # Child streams: the repeatability's draws stay what they are without them.
        noise, programs = rng.spawn(2)
        self.port = ScriptPort(self.box, programs)
        self.programs = Programs(self.box, self.port)
        self._dt = robot.period / NS
        self._force = ForceGuard(robot.safety.tcp_force)
        self._repeatability = Repeatability(robot.repeatability, rng)
        deviation = CURRENTS if robot.series == "cb3" else BUILT_IN
        self.box.estimate.disturb(deviation, noise)

    @property
    def flange(self) -> Pose:
        """Where the flange truly stands or goes in the base frame, the hidden error included."""
        return self._repeatability.true(self.box.target.flange)

    def accept(self, values: Mapping[str, object], arrival: int) -> None:
        """Queue RTDE input values; the first frame with t >= arrival, ns, applies them."""
        self.box.inputs.accept(values, arrival)

    def upload(self, text: str, delay: int = 0) -> bool:
        """Replace the program by this unit of URScript, which starts after `delay`, ns.

        False for a text that the compiler refuses; the log says why.
        """
        return self.programs.upload(text, delay)

    def frame(self, t: int) -> ArmTarget:
        """One control cycle at bench time t, ns."""
        box = self.box
        box.t = t
        box.watchdog.heard(box.inputs.take(t), t)
        box.modes.advance(t)
        self._watch(t)
        self.programs.step()
        self._move()
        if box.jaws.drive(box.signals.outputs, t):
            self._repeatability.redraw()
        return ArmTarget(box.servo.q, self.flange, box.jaws.closed)

    def observe(
        self, t: int, flange: Pose, twist: Vector6, force: Vector6, part_held: bool
    ) -> None:
        """Take the plant's true state at bench time t, ns.

        flange: in the base frame. twist: of the flange, m/s and rad/s, base frame. force: wrench
        at the TCP, N and N·m, base frame. Raises PlantError for a flange out of reach.
        """
        box = self.box
        box.t = t
        box.measured.take(t, self._repeatability.reported(flange), twist, force, box.servo.q)
        box.contact.note(box.measured.q, force)
        box.signals.set_input(box.jaws.sensed_input, box.jaws.sense(part_held, t))

    @property
    def log(self) -> tuple[tuple[int, str], ...]:
        """The controller's log as (bench time in ns, text), oldest first."""
        return tuple(self.box.log)

    def _watch(self, t: int) -> None:
        """Stop an arm that presses too hard, and do what a silent input asks for."""
        pressed = self._force.judge(self.box.measured.force)
        if pressed is not None and self.box.modes.moving:
            self.box.protective_stop(pressed)
        tripped = self.box.watchdog.tripped(t)
        if tripped is None:
            return
        name, action = tripped
        if action is Action.STOP:
            self.box.protective_stop(f"C207A0: fieldbus input disconnected ({name})")
        elif action is Action.PAUSE and self.box.post(Event.PAUSE):
            self.box.say(f"program paused: {name} fell silent")

    def _move(self) -> None:
        """Let the servo follow its set-point, if the brakes are open and the limits allow it."""
        box, servo = self.box, self.box.servo
        if box.force_mode.task is not None and box.modes.moving:
            self._give_way()
        pending, before = servo.pending, servo.q
        flange: Pose | None = None
        if pending is not None and pending != before and not box.modes.moving:
            servo.refuse()
        elif pending is not None and pending != before:
            flange = box.kinematics.forward(pending)
            tips = box.tool.tip(box.target.flange), box.tool.tip(flange)
            reason = judge(Motion(before, pending, *tips, self._dt), box.robot.safety)
            if reason is not None:
                servo.refuse()
                box.protective_stop(reason)
                flange = None
        servo.advance()
        if flange is None and servo.q != before:
            flange = box.kinematics.forward(servo.q)
        box.target.advance(box.target.flange if flange is None else flange)

    def _give_way(self) -> None:
        """Let force mode change the set-point: its compliant axes follow force, not the program."""
        box, servo, kinematics = self.box, self.box.servo, self.box.kinematics
        tool, target = box.tool, box.target
        if servo.pending is None and any(servo.path_qd):
            servo.brake(STOP_DECELERATION)
        pending, at = servo.pending, compose(target.flange, tool.pose)
        reason = box.force_mode.deviation(at, compose(box.measured.flange, tool.pose))
        if reason is not None:
            box.protective_stop(reason)
            return
        wanted = at if pending is None else compose(kinematics.forward(pending), tool.pose)
        box.force_mode.notice(hypot(*box.estimate.mean[:3]))
        tip, path = box.force_mode.step(at, wanted, box.estimate.wrench, target.twist[:3])
        try:
            q = kinematics.inverse(compose(tip, tool.to_flange), servo.q)
            still = servo.q if path == at else kinematics.inverse(compose(path, tool.to_flange), q)
        except ValueError as error:
            box.protective_stop(f"force mode left the arm's reach: {error}")
            return
        servo.give_way(q, still)
