"""Where a contact began, found in what the arm remembers, whatever the estimate's noise."""

import pytest

RISE = 0.4  # N a cycle: 10 N/mm met at 20 mm/s, every 2 ms
DOWN = (0.0, 0.0, -1.0)
ZERO6 = (0.0,) * 6


class Touch:
    """An arm that is pushed, cycle after cycle, by what a test says."""

    def __init__(self, cell, first_cycle):
        self.arm, self.box = cell.arm, cell.box
        self.flange = self.box.target.flange
        self.box.t = first_cycle * self.box.period  # says which part of the noise comes

    def feel(self, force):
        push = (0.0, 0.0, force, 0.0, 0.0, 0.0)
        self.arm.observe(self.box.t + self.box.period, self.flange, ZERO6, push, False)
        return self.box.contact.cycles_since(DOWN)


@pytest.fixture
def made(make_cell):
    return make_cell(model="ur5e", series="e-series", version="5.11.0.108249")


def test_a_contact_began_when_the_force_rose_and_not_before(made):
    for first in range(0, 4096, 4):
        touch = Touch(made, first)
        touch.feel(0.0)
        made.box.estimate.zero()
        assert [touch.feel(0.0) for _ in range(5)] == [0] * 5
        cycles = next(n for n in range(1, 100) if touch.feel(n * RISE))
        assert cycles - 3 <= made.box.contact.cycles_since(DOWN) <= cycles


def test_after_zeroing_only_noise_is_felt(made):
    touch = Touch(made, 0)
    for push in (3.0, -40.0):
        touch.feel(push)
        made.box.estimate.zero()
        assert made.box.estimate.mean == ZERO6
        assert 0.0 < abs(made.box.estimate.wrench[2]) < 2.0
