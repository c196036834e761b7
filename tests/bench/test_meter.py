import pytest

from hil.bench.meter import Meter


def burn():
    return sum(range(20_000))


class Part:
    def work(self):
        return burn()

    def fail(self):
        burn()
        raise KeyError("broken")


def test_a_meter_counts_nothing_until_it_is_on():
    meter, part = Meter(), Part()
    meter.wrap("part", part, "work")
    assert part.work() == burn()
    assert meter.spent == {}


def test_time_adds_up_by_part():
    meter, one, other = Meter(), Part(), Part()
    meter.wrap("one", one, "work")
    meter.wrap("other", other, "work")
    meter.on = True
    one.work()
    first = meter.spent["one"]
    one.work()
    assert 0 < first < meter.spent["one"]
    assert meter.spent["other"] == 0


def test_work_that_fails_is_counted_and_still_fails():
    meter, part = Meter(), Part()
    meter.wrap("part", part, "fail")
    meter.on = True
    with pytest.raises(KeyError, match="broken"):
        part.fail()
    assert meter.spent["part"] > 0


def test_one_objects_methods_are_counted_and_its_likes_are_not():
    meter, measured, other = Meter(), Part(), Part()
    meter.wrap("part", measured, "work")
    meter.on = True
    other.work()
    assert meter.spent == {}
