"""S2 to S6: what the near side makes of a sensor that fails."""

from functools import partial

import pytest

import controller.start
import drivers.nrs.session
from controller.guard import Guard
from drivers.nrs.plausibility import Plausibility
from hil.trial.verdict import Verdict

SLOW = partial(pytest.param, marks=pytest.mark.campaign)


def bound(patch):
    """A guard with a force bound that nothing passes."""
    sound = Guard.__init__

    def init(self, limits, period):
        sound(self, limits.relaxed(1e3), period)

    patch.setattr(Guard, "__init__", init)


def test_spikes_in_a_row_stop_the_arm(law):
    spikes = {"force": 0.1, "spike": 400.0, "spike_rate": 900.0}
    law.holds(lambda trial: trial.outcome.kind.value == "danger", bound, "S2", spikes)


def plausibility(patch):
    """A value that repeats is believed."""
    patch.setattr(Plausibility, "check", lambda self: None)


def test_an_arm_whose_sensor_is_stuck_stops(law):
    law.stops(plausibility, "S3", told="FlatSignalError", after=3)


def flags(patch):
    """Nobody looks at a sample's flags."""
    patch.setattr(drivers.nrs.session, "UNUSABLE", 0)
    patch.setattr(drivers.nrs.session, "VALID", 0xFF)


def test_an_arm_whose_sensor_saturates_stops(law):
    law.holds(lambda trial: "OverloadError" in trial.reason, flags, "S4", at="contact")


def self_test(patch):
    """What the sensor says of a shaken tool is not asked."""
    patch.setattr(controller.start, "self_test", lambda *_: None)


@pytest.mark.parametrize("what", ["sign", SLOW("swap"), SLOW("scale")])
def test_a_sensor_with_wrong_axes_is_refused_before_the_job(law, what):
    def refused(trial):
        return trial.verdict is Verdict.BLOCKED and "SensorAxesError" in trial.reason

    law.holds(refused, self_test, "S5", {"what": what}, at="")


@pytest.mark.parametrize("bit", ["overload", SLOW("supply")])
def test_an_arm_whose_sensor_warns_of_itself_stops(law, bit):
    law.stops(flags, "S6", {"bit": bit})
