"""C1 to C9: what the sensor's driver makes of a bus that fails."""

from functools import partial

import pytest

from controller.guard import Guard
from drivers.nrs.assembler import Assembler, NumberedSample
from drivers.nrs.confinement import Confinement
from drivers.nrs.freshness import Freshness
from drivers.protocol.nrs_sample import decode_pair

SLOW = partial(pytest.param, marks=pytest.mark.campaign)


def ages(patch):
    """Every sample is new."""
    patch.setattr(Freshness, "age", lambda self, number, t: 0)


def test_an_arm_that_gets_no_samples_stops(law):
    law.stops(ages, "C1", told="StaleSampleError")


def test_samples_that_were_held_up_are_old_however_new_they_look(law):
    law.stops(ages, "C2", {"mean": 0.05}, told="StaleSampleError")


def sequence(patch):
    """Halves of one counter are a pair, and whatever pair arrives is the next sample."""

    def join(self, is_force, octets, t):
        half = self._halves.pop(octets[7], None)
        if half is None:
            self._halves[octets[7]] = (is_force, octets, t)
            return None
        return decode_pair(octets, half[1]) if is_force else decode_pair(half[1], octets)

    def number(self, sample, t):
        self._last, self._last_t = (self._last or 0) + 1, t
        return NumberedSample(self._last, sample.wrench, sample.flags)

    patch.setattr(Assembler, "_join", join)
    patch.setattr(Assembler, "_number", number)


def test_a_sample_that_comes_again_is_not_a_new_one(law):
    def told_apart(trial):
        counted = trial.health.duplicates + trial.health.torn > 20
        return counted and trial.outcome.kind.value == "limit"

    law.holds(told_apart, sequence, "C3", {"how": "duplicate", "depth": 2.0}, policy=GivesUp())


class GivesUp:
    def choose(self, observation):
        return None


def one_way(patch):
    """A sample that comes after a newer one is dropped, though nobody has looked at either."""
    sound = Assembler._number

    def number(self, sample, t):
        self.begin()
        return sound(self, sample, t)

    patch.setattr(Assembler, "_number", number)


def test_samples_out_of_order_within_a_period_are_put_in_order(law):
    def ridden_out(trial):
        return trial.outcome is not None and trial.outcome.kind.value == "inserted"

    law.holds(ridden_out, one_way, "C3", {"how": "reorder"}, after=3)


def bound(patch):
    """A guard with a force bound that nothing passes."""
    sound = Guard.__init__

    def init(self, limits, period):
        sound(self, limits.relaxed(1e3), period)

    patch.setattr(Guard, "__init__", init)


def test_a_wrench_that_nobody_felt_stops_the_arm_where_it_is_over_the_bound(law):
    law.holds(lambda trial: trial.outcome.kind.value == "danger", bound, "C4", {"bits": 3.0})


def lengths(patch):
    """Frames are decoded whatever their length."""

    def accept(self, identifier, octets, fd, t):
        sample = self._join(identifier == self._ids.force, octets, t)
        return None if sample is None else self._number(sample, t)

    patch.setattr(Assembler, "accept", accept)


def test_frames_of_a_wrong_length_are_counted_and_nothing_else(law):
    def counted(trial):
        return trial.health.malformed > 0

    law.holds(counted, lengths, "C5", {"what": "both"})


def confinement(patch):
    """Error frames are not minded."""
    patch.setattr(Confinement, "hear", lambda self, frame: None)


def test_an_arm_whose_bus_is_error_passive_stops(law):
    law.stops(confinement, "C6", {"state": "passive"}, told="error-passive")


def test_an_arm_whose_bus_is_off_stops_by_name(law):
    law.stops(confinement, "C7", told="bus-off")


def test_an_arm_whose_samples_come_late_on_a_full_bus_stops(law):
    law.stops(ages, "C8", told="StaleSampleError")


def halves(patch):
    """A half that comes alone is filled up with the last other half."""

    def join(self, is_force, octets, t):
        kept = self.__dict__.setdefault("kept", {})
        kept[is_force] = octets
        if len(kept) < 2 or (is_force and self._halves.pop(octets[7], None)):
            return None
        mask = (1 << 51) - 1
        head = int.from_bytes(kept[True], "little") & mask
        tail = int.from_bytes(octets, "little") & ~mask
        force = (head | tail).to_bytes(8, "little")
        torque = kept[False][:7] + octets[7:]
        return decode_pair(force, torque)

    patch.setattr(Assembler, "_join", join)


@pytest.mark.parametrize("missing", ["torque", SLOW("force")])
def test_an_arm_that_gets_half_wrenches_stops(law, missing):
    law.stops(halves, "C9", {"missing": missing}, told="StaleSampleError")
