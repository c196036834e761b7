"""Buses for the sensor driver's tests, and the guard against leaks."""

import threading

import pytest

from hil.cell.rig.sensor import CanBus
from hil.cell.sensor.gateway import open_gateway


@pytest.fixture(autouse=True)
def no_thread_is_left():
    before = set(threading.enumerate())
    yield
    assert set(threading.enumerate()) - before == set()


@pytest.fixture(
    params=["virtual", "udp_multicast", pytest.param("socketcan", marks=pytest.mark.socketcan)]
)
def gateway(request):
    gateway = open_gateway(
        CanBus(interface=request.param), across_processes=request.param != "virtual", fd=True
    )
    yield gateway
    gateway.close()
