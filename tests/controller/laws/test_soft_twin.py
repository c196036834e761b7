"""The law in its parts commands what the same formulas command, written out flat."""

from math import exp, inf, sin

import numpy as np
import pytest

from controller.laws.bounds import Bounds
from controller.laws.build import build
from controller.laws.delay import SMOOTHING, STEADY
from controller.laws.interface import AxisReading, Reference
from controller.laws.measured import PLAUSIBLE
from controller.laws.motion import MEMORY
from controller.laws.soft import SLOPE, SoftSettings
from controller.laws.stiffness import LONGEST_PATIENCE, STIFFENED, StiffnessSettings

BOUNDS = Bounds(approach=4e-3, push=16e-3, stop=inf)
CONFIG = SoftSettings(
    stiffness=StiffnessSettings(softest=500.0, stiffest=100e3, margin=1.1), compliance=5e-6
)


def clip(value, low, high):
    return low if value < low else high if value > high else value


class Twin:
    """SOFT once more: whole histories and plain formulas instead of parts with memory.

    For readings without gaps, one sample a period, within the sensor's range and below the stop.
    x: commands, m, the start first. k: stiffness. theta: delay. s, w: the surface's place, speed.
    """

    def __init__(self, config, bounds, period):
        self.c, self.b, self.T = config, bounds, period
        self.x, self.v, self.seen = [0.0], 0.0, []
        self.theta, self.flat, self.flat_speed = config.delay, 0, 0.0
        self.s = self.w = self.offset = self.hold = 0.0
        self.counted, self.patience = 0, config.stiffness.patience
        self.lift()

    def lift(self):
        self.touched, self.k, self.loading, self.F, self.P = (
            False, self.c.stiffness.stiffest, True, [], [],
        )  # fmt: skip

    def step(self, push, place, wanted):
        resting = len(self.seen) < round(self.c.rest / self.T)
        measured = self.measure(place, resting)
        if push > self.b.contact:
            self.flat = 0
            speed = clip(self.follow(push, measured, wanted), -self.b.push, self.b.retreat)
        else:
            self.lift()
            speed = 0.0 if resting else -self.b.approach
            if not resting:
                self.watch_delay(measured)
        change = self.b.acceleration * self.T
        self.v = clip(clip(speed, -self.b.speed, self.b.speed), self.v - change, self.v + change)
        self.x.append(self.x[-1] + self.v * self.T)

    def measure(self, place, resting):
        x, gate = self.x[-1], self.c.gate
        if resting and abs(place - x) <= PLAUSIBLE * gate:
            self.counted += 1
            self.offset += (place - x - self.offset) / self.counted
        self.seen.append(place)
        if len(self.seen) < 2:
            return None
        mean = (self.seen[-1] + self.seen[-2]) / 2 - self.offset
        return mean if abs(mean - x) <= gate else None

    def watch_delay(self, measured):
        if self.v != self.flat_speed:
            self.flat, self.flat_speed = 0, self.v
        self.flat += 1
        if self.flat > round(STEADY / self.T) and self.v < 0.0 and measured is not None:
            lag = clip((measured - self.x[-1]) / -self.v, self.c.shortest, self.c.longest)
            self.theta += SMOOTHING * (lag - self.theta)

    def ago(self, delay):
        periods = delay / self.T
        whole = min(int(periods), round(MEMORY / self.T))
        part = min(periods - whole, 1.0)
        past = lambda n: self.x[-1 - n] if n < len(self.x) else 0.0  # noqa: E731
        return (1.0 - part) * past(whole) + part * past(whole + 1)

    def follow(self, push, measured, wanted):
        sent, before = self.ago(self.theta), self.k
        self.learn(push, sent if measured is None else measured, wanted)
        place = sent + push * (1.0 / self.k + self.c.compliance)
        if not self.touched or self.k > STIFFENED * before:
            self.s, self.w = place, 0.0
        elif self.k != before:
            back = min(max(1, round(SLOPE / self.T)), len(self.F) - 1)
            slope = (self.F[-1] - self.F[-1 - back]) / (back * self.T)
            self.s += push * (1.0 / self.k - 1.0 / before)
            self.w += slope * (1.0 / self.k - 1.0 / before)
        self.touched = True
        self.observe(place)
        ahead = self.s + self.w * (self.theta + self.T)
        target = ahead - wanted * (1.0 / self.k + self.c.compliance)
        along = self.w
        return along + (target - self.x[-1] - along * self.T) / max(self.T, self.c.smoothing)

    def observe(self, place):
        pole = exp(-self.c.bandwidth / self.theta * self.T)
        ahead = self.s + self.w * self.T
        self.s = ahead + (1.0 - pole * pole) * (place - ahead)
        faster = self.w + (1.0 - pole) ** 2 * (place - ahead) / self.T
        self.w = clip(faster, -self.c.surface_speed, self.c.surface_speed)

    def learn(self, push, place, wanted):
        error = abs(push - wanted)
        self.loading = error >= 0.1 * wanted and (self.loading or error > 0.5 * wanted)
        if self.F:
            self.hold = max(0.0, self.hold - self.T)
            self.search(push, place)
        self.F.append(push)
        self.P.append(place)

    def search(self, push, place):
        rule = self.c.stiffness
        short = max(1, round(rule.blow / self.T))
        reach = round(rule.look / self.T) + 1 if self.loading and self.hold <= 0.0 else short
        for back in range(1, min(reach, len(self.F)) + 1):
            rise, way = push - self.F[-back], place - self.P[-back]
            if abs(rise) < rule.loud:
                continue
            if back <= short and rise > 0.0 > way and self.blow(rise, -way):
                return
            if abs(way) >= rule.resolution:
                self.secant(rise, way, back <= short)
                return

    def blow(self, rise, way):
        rule = self.c.stiffness
        found = rule.margin * rise / max(way, rule.resolution)
        if self.k >= rule.stiffest or found <= STIFFENED * self.k:
            return False
        self.k, self.hold = min(found, rule.stiffest), self.patience
        self.patience = min(2.0 * self.patience, LONGEST_PATIENCE)
        return True

    def secant(self, rise, way, short):
        rule = self.c.stiffness
        if rise * way >= 0.0:
            return
        ratio = rule.margin * (-rise / way) / self.k
        if short if ratio > 1.0 else self.loading and self.hold <= 0.0:
            self.k = clip(self.k * ratio**rule.share, rule.softest, rule.stiffest)


def pushed(depth, soft, stiff, knee):
    """Force of a contact that turns stiff at `knee`, N."""
    return max(0.0, min(soft * depth, knee + stiff * (depth - knee / soft)))


@pytest.mark.parametrize("period", [8, 2])
@pytest.mark.parametrize("seed", range(20))
def test_the_twin_commands_the_same(seed, period):
    rng, T = np.random.default_rng(seed), period * 1e-3
    soft, knee = np.exp(rng.uniform(np.log(1e3), np.log(30e3))), rng.uniform(2.0, 20.0)
    stiff, lag = soft * rng.uniform(1.0, 20.0), int(rng.integers(1, 5))
    axis, twin = build("soft", CONFIG, BOUNDS, period * 1_000_000), Twin(CONFIG, BOUNDS, T)
    axis.reset(0.0)
    sent, worst, most = [0.0] * (lag + 1), 0.0, 0.0
    for count in range(round(4.0 / T)):
        surface = -2e-3 + 1e-3 * sin(3.0 * count * T) * (count * T > 2.0)
        push = pushed(surface - sent[-1 - lag], soft, stiff, knee) + 0.01 * rng.standard_normal()
        place = sent[-lag] + 5e-6 * rng.standard_normal()
        step = axis.step(AxisReading(count * period * 1_000_000, (push,), place), Reference(10.0))
        twin.step(push, place, 10.0)
        sent.append(sent[-1] + step)
        worst, most = max(worst, abs(twin.x[-1] - sent[-1])), max(most, push)
    assert most > 5.0
    assert worst <= 1e-14
