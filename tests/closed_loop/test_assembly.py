from multiprocessing import active_children

from controller.job import assembly
from controller.loop import Loop
from controller.outcome import Kind
from controller.start import bring_up
from hil.app.near import drivers, limits, plan, task_frame
from hil.app.process import CellProcess
from hil_fixtures.testbed import open_testbed
from learner.scripted import pose_script


def test_a_cable_is_picked_up_found_its_slot_and_released_at_goal_depth(perform):
    depths = []

    def watch(cycle, course, cell):
        part = cell.truth().part
        if course.name == "insert" and part.name == "FFC1":
            depths.append((part.depth, max(map(abs, part.tip[:2]))))

    result = perform(watch=watch)
    assert result.outcome.kind is Kind.INSERTED
    depth, off = depths[-1]
    assert depth >= 2.0e-3
    assert off < 0.1e-3


def test_no_period_of_a_lockstep_run_is_missed_and_no_sample_lost(perform):
    result = perform()
    assert result.outcome.misses == 0
    health = result.health
    assert (health.gaps, health.duplicates, health.torn, health.malformed) == (0, 0, 0, 0)


def test_the_contact_force_settles_at_five_newtons_without_overshoot(perform):
    pushes = []

    def watch(cycle, course, cell):
        if course.name == "contact":
            pushes.append(cycle.wrench[2])

    perform(watch=watch)
    assert abs(pushes[-1] - 5.0) < 0.2
    assert max(pushes) < 5.25


def test_a_cell_that_vanishes_ends_the_run_with_the_link_named(rig):
    def stay_while_the_cell_dies(course):
        for child in active_children():
            child.kill()
        while True:
            yield from course.to(course.setpoint)

    with CellProcess(rig, 1, "lockstep", record=False) as cell:
        near = drivers(rig, cell.doors)
        bring_up(near.arm, near.sensor)
        loop = Loop(near.arm, near.sensor, task_frame(rig))
        outcome = loop.run(stay_while_the_cell_dies, limits(rig))
        near.arm.close()
        near.sensor.close()
    assert outcome.kind is Kind.FAULT
    assert "LinkError" in outcome.reason


def test_a_part_that_is_not_there_ends_the_job_without_a_search(rig):
    part = rig.fixture.parts[0]
    elsewhere = part.model_copy(update={"position": (-0.33, -0.11, 0.055)})
    with open_testbed(rig) as bed:
        bring_up(bed.near.arm, bed.near.sensor)
        whole = plan(rig, elsewhere, (0, 0, 0))
        loop = Loop(bed.near.arm, bed.near.sensor, task_frame(rig))
        policy = pose_script(whole.search, 0.0)
        outcome = loop.run(
            lambda course: assembly(course, whole, bed.near.sensor, bed.near.gripper, policy),
            limits(rig),
        )
    assert outcome.kind is Kind.NO_GRIP
    assert outcome.steps == 0
