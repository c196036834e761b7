"""Child runs of pytest in a user's own repository, on a cell of little physics."""

import pytest

RIG = """
name: bench
features: [camera]
robot: {model: ur5, series: cb3, version: 3.15.8.106339}
physics: {plant: wall}
can: {interface: virtual}
sensor: {boot_time: 8 ms}
"""

REAL = """
name: lab
rig: real
clock: wall
robot: {host: 127.0.0.1, ports: {rtde: 40004, dashboard: 40001, secondary: 40002}}
sensor: {wire: tcp, tcp: {host: 127.0.0.1, port: 40003}}
"""


@pytest.fixture
def repository(pytester, monkeypatch):
    """A user's repository with packages whose names this project has too, and two rig files."""
    monkeypatch.delenv("PYTEST_ADDOPTS", raising=False)
    monkeypatch.delenv("PYTEST_XDIST_WORKER", raising=False)
    pytester.makefile(".yaml", bench=RIG, lab=REAL)
    pytester.makepyfile(
        **{
            "drivers/__init__": "",
            "drivers/my_arm": "NAME = 'mine'",
            "fixtures/__init__": "",
            "fixtures/parts": "PARTS = 3",
        }
    )
    pytester.makeini("[pytest]\npythonpath = .\naddopts = -p no:cacheprovider\n")
    return pytester


@pytest.fixture
def child(repository):
    """Runs the user's tests in a process of their own."""

    def run(*options, **files):
        repository.makepyfile(**files)
        loaded = () if "-p" in options else ("-p", "hil_fixtures.plugin")
        return repository.runpytest_subprocess(*loaded, *options, timeout=120)

    return run
