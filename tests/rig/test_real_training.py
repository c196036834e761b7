"""A training on real devices that dies: what was met stays met, as no danger comes twice."""

from contextlib import closing, contextmanager

import pytest

from controller.outcome import Kind
from hil.app.inline import InlineCell
from hil.app.sessions import Training, train
from hil.app.train import Schedule
from hil.cell.rig import parse
from hil.cli.shipped import read
from learner import checkpoint

EMULATED = parse(read("ffc_learning")[1].decode())
TOUCHY = (1.5, 1.5, 2.0, 1.0)
"""Limits under which the contact force itself, 5 N, is a danger in every episode."""


@contextmanager
def devices(rig):
    """An emulated cell in the place of real devices, in lockstep so that nothing can be late."""
    with InlineCell(rig, 1, "lockstep", record=False) as cell:
        yield cell.doors


def served():
    """A rig whose sensor serves TCP, at any free ports."""
    tcp = EMULATED.sensor.tcp.model_copy(update={"enabled": True, "port": 0})
    sensor = EMULATED.sensor.model_copy(update={"tcp": tcp})
    return EMULATED.on_free_ports().model_copy(update={"sensor": sensor})


def named_real(doors):
    """The same rig as one of real devices at these doors."""
    rig = served()
    host, port = doors.sensor
    tcp = rig.sensor.tcp.model_copy(update={"host": host, "port": port})
    sensor = rig.sensor.model_copy(update={"wire": "tcp", "tcp": tcp})
    ports = rig.robot.ports.model_copy(update=dict(doors.ports))
    robot = rig.robot.model_copy(update={"host": doors.host, "ports": ports})
    limits = rig.limits.model_copy(update={"force_bound": TOUCHY})
    changes = {"rig": "real", "clock": "wall", "robot": robot, "sensor": sensor, "limits": limits}
    return rig.model_copy(update=changes)


@pytest.fixture
def path(tmp_path):
    return tmp_path / "learner.hil"


def told(doors, path):
    """The training's results as they come, on the devices behind these doors."""
    schedule = Schedule((("FFC1", 2),))
    training = Training(named_real(doors), b"the rig's text", "wdql", 1, schedule)
    return closing(train(training, path, lambda *_: None, resume=True))


def test_a_danger_is_on_disk_before_it_is_told_and_stays_counted_after_a_restart(path):
    with devices(served()) as doors, told(doors, path) as results:
        assert next(results).kind is Kind.DANGER
        assert checkpoint.read(path).episodes == 1
    with devices(served()) as doors, told(doors, path) as results:
        assert [(one.number, one.kind) for one in results] == [(2, Kind.DANGER)]
    assert checkpoint.read(path).episodes == 2
