"""The rig's sensor rate reaches both ends of the wire."""

import pytest

from controller.start import bring_up
from drivers.interfaces import Freshness
from hil.cell.rig import parse
from hil_fixtures.testbed import open_testbed


@pytest.mark.parametrize(("rate", "samples"), [("1 kHz", 8), ("500 Hz", 4), ("250 Hz", 2)])
def test_samples_are_fresh_at_every_rate_of_the_sensor(rate, samples):
    rig = parse(
        f"name: x\nphysics: {{plant: wall}}\nsensor: {{rate: {rate}, boot_time: 8 ms}}"
    ).on_free_ports()
    with open_testbed(rig) as bed:
        arm, sensor = bed.near.arm, bed.near.sensor
        bring_up(arm, sensor, tare_samples=50)
        for _ in range(20):
            reading = sensor.read(arm.read().t)
            arm.hold()
        assert reading.freshness is Freshness.OK
        assert abs(len(reading.samples) - samples) <= 1  # the sensor's clock is its own
        assert reading.age <= 2e9 / rig.sensor.rate
