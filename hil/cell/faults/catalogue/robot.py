"""R1 to R10: the robot controller and its arm."""

from typing import Final

from hil.cell.faults.row import HOLDING, Parameter, Phase, Place, Row, word

_MOVING: Final = (Phase.FREE, Phase.APPROACH, Phase.SEARCH, Phase.INSERT, Phase.RETRACT)

ROBOT: Final = (
    Row(
        "R1", "robot.protective_stop", "Protective stop", Place.ROBOT, (),
        "no motion until released; controller states reset; the episode ends by the reward's rule",
        "safety mode; no command accepted; no force step on resuming",
        lasting=False,
    ),
    Row(
        "R2", "robot.emergency_stop", "Emergency stop", Place.ROBOT,
        (word("category", "0", "1"),),
        "as R1, power off; re-arming is an explicit act",
        "robot mode power-off; re-arming stands in the log",
        lasting=False,
    ),
    Row(
        "R3", "robot.program", "Program stopped or paused", Place.ROBOT,
        (word("what", "stop", "pause"),),
        "notice within W cycles; no silent waiting",
        "runtime state; host's state within W",
    ),
    Row(
        "R4", "robot.speed_scaling", "Speed scaling changed", Place.ROBOT,
        (Parameter("factor", 0.3, "", 0.0, 1.0),),
        "the controller accounts for it; no wind-up",
        "tracking error bounded; force below f_b",
    ),
    Row(
        "R5", "robot.joint_limit", "A joint limit comes near", Place.ROBOT,
        (Parameter("margin", 0.0, "rad", 0.0, 6.3),),
        "command clipped or refused before the limit",
        "joints within their limits less the margin",
        phases=_MOVING,
    ),
    Row(
        "R6", "robot.safety_limit", "Safety plane, TCP speed or force limit violated", Place.ROBOT,
        (
            word("what", "speed", "plane", "force"),
            Parameter("speed", 1e-3, "m/s", 0.0, 10.0),
            Parameter("height", 1e-3, "m", 0.0, 1.0),
            Parameter("force", 2.0, "N", 0.0, 1000.0),
        ),
        "the robot stops; the host sees R1; at most k retries",
        "retries at most k",
        phases=_MOVING,
    ),
    Row(
        "R7", "robot.bad_command", "A command that the robot must reject", Place.ROBOT,
        (word("value", "nan", "jump"), Parameter("jump", 0.05, "m", 0.0, 1.0)),
        "the host never sends such; the robot rejects it",
        "arm stands; program error or protective stop in the log",
    ),
    Row(
        "R8", "robot.payload", "Payload or tool wrong", Place.ROBOT,
        (Parameter("mass", 0.5, "kg", -5.0, 5.0), Parameter("tcp", 0.0, "m", -0.05, 0.05)),
        "the bias is seen, compensated or refused",
        "residual of gravity compensation",
    ),
    Row(
        "R9", "robot.pose_offset", "Calibration off: poses are wrong", Place.ROBOT,
        (
            Parameter("dx", 0.3e-3, "m", -0.02, 0.02),
            Parameter("dy", 0.3e-3, "m", -0.02, 0.02),
            Parameter("dz", 0.0, "m", -0.02, 0.02),
            Parameter("rotation", 0.0, "rad", -0.2, 0.2),
        ),
        "the search in contact stays bounded",
        "force bound",
        phases=(Phase.FREE, *HOLDING),
    ),
    Row(
        "R10", "robot.reboot", "Controller restarts", Place.ROBOT,
        (Parameter("down", 0.5, "s", 0.0, 60.0),),
        "as T5, and the arm is brought up anew",
        "path through the robot's modes",
        lasting=False,
    ),
)  # fmt: skip
