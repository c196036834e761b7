"""The near side of a rig: drivers at the cell's doors, and the rig's numbers as theirs.

The same drivers at another address are a real cell's.
"""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from math import pi
from typing import NamedTuple

import numpy as np

from controller.frames import TaskFrame
from controller.guard import Limits
from controller.place import Place
from controller.self_test import Load
from controller.settings import Insertion, Jam, Plan, Press, Search, Travel
from drivers.interfaces import ForceTorqueSensor
from drivers.ur.arm import Tap, UrArm, UrPorts
from drivers.ur.gripper import DigitalGripper
from drivers.ur.program import ServoProgram
from hil.app.wrist import wrist_sensor
from hil.cell.errors import RigError
from hil.cell.rig import Rig
from hil.cell.rig.parts import Part
from hil.cell.serve import Doors
from hil.cell.streams import stream

NS = 1_000_000_000
LIMIT = 5.0
"""Wall s of silence after which the arm's links count as dead."""


class NearSide(NamedTuple):
    """Connected to nothing yet: bringing up is the controller's work."""

    arm: UrArm
    sensor: ForceTorqueSensor
    gripper: DigitalGripper


def drivers(rig: Rig, doors: Doors, tap: Tap | None = None, limit: float = LIMIT) -> NearSide:
    """The rig's drivers for a cell behind these doors; tap hears every RTDE data package.

    limit: wall s of silence after which a link counts as dead.
    """
    ports, tool = doors.ports, rig.tool
    program = ServoProgram(
        tcp=(0.0, 0.0, tool.length, 0.0, 0.0, 0.0),
        mass=tool.mass,
        centre_of_gravity=(0.0, 0.0, tool.centre_of_mass),
        silence=rig.limits.command_age,
        step=min(rig.limits.step, rig.limits.speed * rig.robot.period / NS),
        turn=rig.limits.step_rotation,
    )
    arm = UrArm(
        doors.host,
        UrPorts(ports["rtde"], ports["dashboard"], ports["secondary"]),
        program=program,
        rate=rig.robot.rate,
        limit=limit,
        tries=rig.limits.connect_tries,
        unanswered=rig.limits.unanswered,
        tap=tap,
    )
    jaws = rig.robot.jaws
    return NearSide(arm, wrist_sensor(rig, doors), DigitalGripper(arm, jaws.output, jaws.sensed))


@contextmanager
def near_side(
    rig: Rig, doors: Doors, tap: Tap | None = None, limit: float = LIMIT
) -> Iterator[NearSide]:
    """The rig's drivers, closed at the end whatever happened to them: the arm first."""
    near = drivers(rig, doors, tap, limit)
    with ExitStack() as stack:
        stack.callback(near.sensor.close)
        stack.callback(near.arm.close)
        yield near


def task_frame(rig: Rig) -> TaskFrame:
    """The connector as the near side believes it stands."""
    return TaskFrame(rig.connector.position, rig.connector.rotation)


def limits(rig: Rig) -> Limits:
    """What the guard enforces."""
    of = rig.limits
    return Limits(
        force_bound=of.force_bound,
        workspace=of.workspace,
        step=of.step,
        step_rotation=of.step_rotation,
        speed=of.speed,
        sample_age=round(of.sample_age * NS),
        following=of.following,
    )


def load(rig: Rig) -> Load:
    """What hangs below the sensor."""
    return Load(rig.tool.mass, rig.limits.mass_error)


def part_named(rig: Rig, name: str) -> Part:
    """One of the rig's parts; RigError lists them."""
    for part in rig.fixture.parts:
        if part.name == name:
            return part
    known = ", ".join(part.name for part in rig.fixture.parts) or "none"
    raise RigError(f"part '{name}' is not in this rig; it has: {known}")


def start_cells(rig: Rig, rng: np.random.Generator) -> tuple[int, int, int]:
    """Where an episode starts, in steps off the slot's nominal place."""
    x, y, theta = (int(rng.integers(-half, half + 1)) for half in rig.task.start_cells)
    return x, y, theta


def plan(rig: Rig, part: Part, cells: tuple[int, int, int]) -> Plan:
    """One assembly of `part`, its search starting so many steps off."""
    task = rig.task
    at = task_frame(rig).from_base((*part.position, pi, 0.0, 0.0))
    start = Place(
        cells[0] * task.step,
        cells[1] * task.step,
        task.clearance,
        cells[2] * task.step_rotation,
    )
    return Plan(
        part=at._replace(theta=part.rotation - rig.connector.rotation),
        start=start,
        travel=Travel(),
        press=Press(force=task.contact_force),
        search=Search(task.step, task.step_rotation, task.max_steps, task.search_cells),
        insertion=Insertion(goal_depth=task.goal_depth, jam=Jam(task.on_jam), jams=task.max_jams),
        drift=rig.limits.drift,
    )


def start_plan(rig: Rig, part: Part, seed: int) -> Plan:
    """The plan of the run with this seed."""
    return plan(rig, part, start_cells(rig, stream(seed, "task.start")))
