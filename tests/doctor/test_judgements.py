"""What `hil doctor` makes of what it measured: each fault has its verdict and its advice."""

import json
import os

import numpy as np
import pytest

from drivers.interfaces import SensorHealth
from drivers.protocol.rtde_setup import ControllerVersion
from hil.cell.rig.robot import Robot
from hil.cell.rig.sensor import CanBus, Sensor
from hil.doctor import bus, host, robot, wrist
from hil.doctor.finding import Verdict

CAN = CanBus(interface="socketcan", channel="can0")


def link(state="ERROR-ACTIVE", bitrate=1_000_000, flags=("UP",), kind="can"):
    details = {"state": state, "bittiming": {"bitrate": bitrate}}
    return json.dumps(
        [{"flags": list(flags), "linkinfo": {"info_kind": kind, "info_data": details}}]
    )


@pytest.mark.parametrize(
    ("text", "verdict", "told"),
    [
        (link(), Verdict.OK, ""),
        (link("ERROR-WARNING"), Verdict.WARN, "termination"),
        (link("ERROR-PASSIVE"), Verdict.FAIL, "acknowledges"),
        (link("BUS-OFF"), Verdict.FAIL, "ip link set can0 type can restart-ms"),
        (link("STOPPED"), Verdict.FAIL, "ip link set can0 up type can bitrate 1000000"),
        (link(bitrate=500_000), Verdict.FAIL, "the rig says 1000000 bit/s"),
        (link(flags=()), Verdict.FAIL, "ip link set can0 up"),
        (link(kind="vcan"), Verdict.OK, ""),
        (link("SLEEPING"), Verdict.WARN, "look at"),
    ],
)
def test_the_kernels_word_on_a_bus_is_judged(text, verdict, told):
    found = bus.judged(text, CAN)
    assert found.verdict is verdict
    assert told in found.advice


@pytest.mark.parametrize(
    ("version", "verdict"),
    [
        (ControllerVersion(3, 15, 8, 106339), Verdict.OK),
        (ControllerVersion(3, 14, 0, 1), Verdict.WARN),
        (ControllerVersion(5, 11, 0, 1), Verdict.FAIL),
    ],
)
def test_another_software_is_a_warning_and_another_series_a_failure(version, verdict):
    assert robot.version(version, Robot()).verdict is verdict


def packages(missing=(), late=0.0):
    kept = [k for k in range(250) if k not in missing]
    return robot.Stretch([k * 0.008 for k in kept], [k * 0.008 + late * (k > 99) for k in kept])


@pytest.mark.parametrize(
    ("stretch", "expected", "verdict"),
    [
        (packages(), 125, Verdict.OK),
        (packages(late=0.02), 125, Verdict.WARN),
        (packages(missing={50}), 125, Verdict.WARN),
        (packages(missing=set(range(50, 80))), 125, Verdict.FAIL),
        (packages(), 500, Verdict.FAIL),
        (robot.Stretch([1.0, 1.0], [0.0, 0.008]), 125, Verdict.FAIL),
    ],
)
def test_a_rate_is_judged_by_the_controllers_own_time(stretch, expected, verdict):
    assert robot.rate(stretch, expected).verdict is verdict


@pytest.mark.parametrize(("reply", "verdict"), [("true", Verdict.OK), ("false", Verdict.FAIL)])
def test_an_e_series_in_local_control_fails_with_the_way_there(reply, verdict):
    finding = robot.remote(reply)
    assert finding.verdict is verdict
    assert ("Remote" in finding.advice) == (verdict is Verdict.FAIL)


@pytest.mark.parametrize(
    ("late", "verdict"),
    [
        ([1e-4] * 1000, Verdict.OK),
        ([1e-4] * 999 + [5e-3], Verdict.WARN),
        ([1e-4] * 900 + [5e-3] * 100, Verdict.FAIL),
    ],
)
def test_jitter_is_judged_by_the_control_period(late, verdict):
    assert host.judged(late, 8e-3).verdict is verdict


def stretch(samples=1000, gaps=0, stale=0, sigma=0.05, mean=0.0):
    rng = np.random.default_rng(1)
    wrenches = rng.normal(mean, [sigma] * 3 + [sigma * 0.016] * 3, (1000, 6))
    lost = SensorHealth(samples, gaps, 0, 0, 0, 0, True, "")
    return wrist.Stretch(1.0, wrenches, stale, False, lost)


@pytest.mark.parametrize(
    ("measured", "verdict"),
    [
        (stretch(), Verdict.OK),
        (stretch(gaps=1), Verdict.WARN),
        (stretch(stale=1), Verdict.WARN),
        (stretch(samples=200), Verdict.FAIL),
    ],
)
def test_a_sensors_stream_is_judged_by_rate_and_losses(measured, verdict):
    assert wrist.stream(measured, 1000.0).verdict is verdict


def test_a_noisy_signal_and_a_loaded_zero_are_warnings():
    assert wrist.signal(stretch(), Sensor()).verdict is Verdict.OK
    assert wrist.signal(stretch(sigma=0.5), Sensor()).verdict is Verdict.WARN
    assert wrist.zero(stretch(mean=1.0), Sensor()).verdict is Verdict.OK
    assert wrist.zero(stretch(mean=150.0), Sensor()).verdict is Verdict.WARN


def test_asking_for_real_time_priority_leaves_the_process_as_it_was():
    before = os.sched_getscheduler(0)
    assert host.priority().verdict in {Verdict.OK, Verdict.WARN}
    assert os.sched_getscheduler(0) == before
