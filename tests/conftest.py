"""What holds for every test: nothing that it opened outlives it."""

from collections.abc import Iterator

import pytest
from hypothesis import HealthCheck, settings

from hil.cell.sensor.can_interfaces import up_can_interfaces
from hil_fixtures.plugin.health import Health

# How long an example takes says how busy the machine is, and nothing about the law it tests.
settings.register_profile("hil", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("hil")


def pytest_report_header() -> str:
    found = ", ".join(up_can_interfaces())
    return f"kernel CAN: {found or 'none is up; `make test-can` runs the socketcan tests'}"


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out what needs kernel CAN where none is up; tests/socketcan boots a kernel for it."""
    if up_can_interfaces():
        return
    left_out = [item for item in items if item.get_closest_marker("socketcan")]
    if left_out:
        config.hook.pytest_deselected(items=left_out)
        items[:] = [item for item in items if item not in left_out]


@pytest.fixture(autouse=True)
def _leaves_no_thread_socket_or_process() -> Iterator[None]:
    before = Health.now()
    yield
    assert not before.leaks()
