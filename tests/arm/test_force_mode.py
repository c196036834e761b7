"""Force mode on the plant's contact: the arm presses on the wall as it is told."""

import numpy as np
import pytest

from drivers.protocol.rtde_states import SafetyMode
from hil.cell.arm.force.mode import DAMPING, ForceMode, Task
from hil.cell.arm.kinematics import Kinematics
from hil.cell.arm.modes import Event
from hil.cell.arm.pose import IDENTITY, ZERO3, ZERO6
from hil.cell.assemble import build_bench
from hil.cell.geometry import TaskGeometry
from hil.cell.plant.interface import Contact
from hil.cell.rig import parse

SERIES = {
    "cb3": "model: ur5, series: cb3, version: 3.15.8.106339",
    "e-series": "model: ur5e, series: e-series, version: 5.11.0.108249",
}
DOWN = "[0, 0, 1, 0, 0, 0]"


class Press:
    """A cell whose TCP hangs 1 mm over a wall, and what it does from there."""

    def __init__(self, series, stiffness=10e3, text=None):
        rig = parse(
            text
            or f"name: press\nrobot: {{{SERIES[series]}}}\n"
            f"physics: {{plant: wall, wall_stiffness: {stiffness} N/m}}\n"
        )
        self.bench = build_bench(rig, 1)
        self.box = self.bench.arm.box
        self.length = rig.tool.length
        self.box.post(Event.BRAKE_RELEASE)
        self.seconds(2.0)

    def seconds(self, seconds):
        """Force along z on the TCP, N, and stage, of each period."""
        trace = []
        for _ in range(round(seconds * 1e9) // self.bench.period):
            self.bench.tick()
            trace.append((self.box.measured.force[2], *self.bench.truth.stage[:3]))
        return np.array(trace)

    def run(self, body):
        """Start a program after an approach to 1 mm over the wall."""
        down = self.bench.truth.stage[2] - 1e-3
        self.bench.arm.upload(
            f"def press():\n  set_tcp(p[0, 0, {self.length}, 0, 0, 0])\n"
            f"  over = get_target_tcp_pose()\n  over[2] = over[2] - {down}\n"
            f"  movel(over, a = 1, v = 0.2)\n  zero_ftsensor()\n{body}\nend\n"
        )
        self.seconds(1.2)

    @property
    def log(self):
        return "\n".join(text for _, text in self.bench.arm.log)


def pressing(force, selection=DOWN, limits="[0.1, 0.1, 0.1, 0.2, 0.2, 0.2]"):
    return (
        "  while True:\n    force_mode(p[0, 0, 0, 0, 0, 0], "
        f"{selection}, [0, 0, {-force}, 0, 0, 0], 2, {limits})\n    sync()\n  end"
    )


@pytest.mark.parametrize("stiffness", [1e3, 10e3, 50e3])
@pytest.mark.parametrize(("series", "noise"), [("cb3", 1.5), ("e-series", 0.3)])
def test_the_commanded_force_settles_on_soft_and_stiff_walls(series, noise, stiffness):
    cell = Press(series, stiffness)
    cell.run(pressing(10))
    cell.seconds(12 * 2100 / stiffness + 1.0)
    force = cell.seconds(0.5)[:, 0]
    # Zeroed at once after a move: what the tool's inertia pulls there stays as an offset.
    assert np.mean(force) == pytest.approx(10.0, abs=3 * noise)
    assert np.std(force) < 0.3 * noise


def test_a_stiff_wall_is_met_without_bouncing():
    cell = Press("cb3", 50e3)
    cell.run(pressing(10))
    force = cell.seconds(2.0)[:, 0]
    touched = int(np.argmax(force > 1.0))
    assert force[touched:].min() > 0.0
    assert force.max() < 20.0


@pytest.mark.parametrize("series", ["cb3", "e-series"])
def test_an_arm_well_above_the_surface_presses_within_two_seconds(series):
    cell = Press(series, 10e3)
    cell.run("  over[2] = over[2] + 0.005\n  movel(over)\n  zero_ftsensor()\n" + pressing(10))
    force = cell.seconds(2.0)[:, 0]
    assert force[-10:] == pytest.approx(10.0, abs=4.5)
    touched = int(np.argmax(force > 1.0))
    assert force[touched:].min() > 0.0
    assert force.max() < 30.0


def test_axes_that_are_not_compliant_follow_the_program():
    cell = Press("cb3")
    cell.run(
        "  force_mode(p[0,0,0,0,0,0], " + DOWN + ", [0,0,-10,0,0,0], 2, [1,1,1,1,1,1])\n"
        "  sleep(3)\n"
        "  aside = over\n  aside[0] = aside[0] + 0.02\n  aside[2] = aside[2] + 0.05\n"
        "  movel(aside, v = 0.02)\n  while True:\n    sync()\n  end"
    )
    before = cell.seconds(2.5)[-1]
    after = cell.seconds(3.0)[-1]
    moved = np.hypot(*(after - before)[1:3])
    assert moved == pytest.approx(0.02, abs=2e-4)
    assert after[0] == pytest.approx(10.0, abs=4.5)


def test_the_speed_limit_of_a_compliant_axis_holds():
    cell = Press("cb3")
    cell.run(
        "  over[2] = over[2] + 0.05\n  movel(over)\n" + pressing(40, limits="[1,1,2e-3,1,1,1]")
    )
    fall = np.diff(cell.seconds(1.0)[:, 3]) / 8e-3
    assert fall[50:].min() == pytest.approx(-2e-3, rel=1e-3)


def test_a_deviation_beyond_the_limit_is_a_protective_stop():
    cell = Press("cb3")
    cell.run(
        "  force_mode(p[0,0,0,0,0,0], [0,0,0,1,0,0], [0,0,0,0,0,0], 2, [1,1,1e-4,1,1,1])\n"
        "  speedl([0, 0, -0.02, 0, 0, 0], 1, 2)"
    )
    cell.seconds(0.5)
    assert cell.box.modes.safety is SafetyMode.PROTECTIVE_STOP
    assert "force mode: axis 2 is" in cell.log


def test_the_arm_stays_where_force_mode_ends():
    cell = Press("cb3")
    cell.run(
        "  force_mode(p[0,0,0,0,0,0], " + DOWN + ", [0,0,-10,0,0,0], 2, [1,1,1,1,1,1])\n"
        "  sleep(2)\n  end_force_mode()\n  stopl(10)\n  while True:\n    sync()\n  end"
    )
    cell.seconds(2.5)
    z = cell.seconds(0.5)[:, 3]
    assert np.ptp(z) < 1e-6


def test_force_mode_ends_with_its_program():
    cell = Press("cb3")
    cell.run(pressing(10))
    assert cell.box.force_mode.task is not None
    cell.box.force_mode.tune(damping=0.5)
    cell.bench.arm.programs.stop()
    assert cell.box.force_mode.task is None
    assert cell.box.force_mode.damping == DAMPING


def test_move_until_contact_stops_and_returns_to_the_surface():
    cell = Press("e-series")
    cell.run(
        "  while True:\n    back = tool_contact(p[0, 0, -1, 0, 0, 0])\n    if back <= 0:\n"
        "      speedl([0, 0, -0.01, 0, 0, 0], 0.5, t = get_steptime())\n    else:\n"
        "      q = get_actual_joint_positions_history(back)\n      stopl(3)\n      movel(q)\n"
        '      textmsg("touched")\n      halt\n    end\n  end'
    )
    trace = cell.seconds(1.5)
    assert "touched" in cell.log
    assert trace[:, 0].max() > 4.0
    assert abs(trace[-1, 3]) < 1e-4


def test_a_hand_moves_the_arm_in_freedrive_and_no_program_does():
    cell = Press("e-series")
    cell.run("  freedrive_mode()\n  sleep(0.1)\n  movej(get_actual_joint_positions())")
    cell.seconds(0.2)
    assert "cannot move in freedrive" in cell.log


def test_an_impossible_task_ends_the_program():
    cell = Press("cb3")
    cell.run("  force_mode(p[0,0,0,0,0,0], " + DOWN + ", [0,0,1,0,0,0], 4, [1,1,1,1,1,1])")
    assert "force mode type 4 is none of (1, 2, 3)" in cell.log


def test_more_damping_moves_slower_under_the_same_force():
    ways = []
    for damping in (0.0, 0.5, 1.0):
        mode = ForceMode(0.008)
        mode.tune(damping=damping)
        down = (False, False, True, False, False, False)
        mode.start(Task(IDENTITY, down, (0, 0, -10, 0, 0, 0), 2, (1.0,) * 6))
        at = IDENTITY
        for _ in range(100):
            mode.notice(2.0)
            at, _ = mode.step(at, at, ZERO6, ZERO3)
        ways.append(-at.position[2])
    assert ways[0] > ways[1] > ways[2] > 0
    assert ways[0] == pytest.approx(10 / 2000 * 0.8, rel=0.02)


def test_a_gripped_cable_is_pressed_on_the_connectors_face_with_the_commanded_force():
    text = f"name: press\nrobot: {{{SERIES['cb3']}}}\nphysics: {{plant: mujoco}}\n"
    rig = parse(text)
    home = Kinematics(rig.robot.model).forward(rig.robot.home)
    x, y, z, turn = TaskGeometry(ZERO3, 0.0, rig.tool.length).stage(home)
    part = f"{{name: A, position: [{x!r} m, {y!r} m, {z!r} m], rotation: {turn!r} rad}}"
    cell = Press("cb3", text=f"{text}fixture: {{parts: [{part}]}}\n")
    cell.box.estimate.disturb((0.0, 0.0), np.random.default_rng(1))
    x, _, z, _ = cell.bench.truth.stage
    cell.bench.arm.upload(
        f"def press():\n  set_tcp(p[0, 0, {cell.length}, 0, 0, 0])\n"
        "  set_standard_digital_out(0, True)\n  sleep(0.2)\n  over = get_target_tcp_pose()\n"
        f"  over[0] = over[0] - {x - 0.02}\n  movel(over, a = 1, v = 0.2)\n"
        f"  over[2] = over[2] - {z - 0.001}\n  movel(over, a = 1, v = 0.2)\n"
        "  sleep(0.3)\n  zero_ftsensor()\n"
        f"{pressing(3)}\nend\n"
    )
    cell.seconds(6.0)
    assert cell.bench.truth.part.contact is Contact.FACE
    assert np.mean(cell.seconds(1.0)[:, 0]) == pytest.approx(3.0, abs=0.15)
