"""Delay laws of a link: how long a message travels, drawn from a seeded stream."""

from typing import Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import model_validator

from hil.cell.rig.quantity import Seconds
from hil.cell.rig.section import Section

NS = 1_000_000_000


class LatencyLaw(Section):
    """mean and jitter (1 sigma, or half width for `uniform`) of one direction; never below 0."""

    law: Literal["constant", "uniform", "normal", "gamma"] = "constant"
    mean: Seconds = 0.0
    jitter: Seconds = 0.0

    @model_validator(mode="after")
    def _sane(self) -> "LatencyLaw":
        if self.law == "gamma" and not (self.mean > 0 and self.jitter > 0):
            raise ValueError("a gamma law needs a mean and a jitter above 0 s")
        return self

    @property
    def least(self) -> int:
        """No delay of this law is shorter, ns."""
        if self.law == "gamma":
            return 1
        spread = self.jitter if self.law == "uniform" else 0.0
        return 0 if self.law == "normal" else max(0, round((self.mean - spread) * NS))

    def draw(self, rng: np.random.Generator) -> int:
        """One delay, ns."""
        return self.draws(rng, 1)[0]

    def draws(self, rng: np.random.Generator, count: int) -> list[int]:
        """So many delays, ns: one call for many costs little more than for one."""
        seconds = np.maximum(self._seconds(rng, count), 0.0)
        return [max(self.least, int(ns)) for ns in np.rint(seconds * NS)]

    def _seconds(self, rng: np.random.Generator, count: int) -> NDArray[np.float64]:
        if self.law == "uniform":
            return rng.uniform(self.mean - self.jitter, self.mean + self.jitter, count)
        if self.law == "normal":
            return rng.normal(self.mean, self.jitter, count)
        if self.law == "gamma":
            shape = (self.mean / self.jitter) ** 2
            return rng.gamma(shape, self.mean / shape, count)
        return np.full(count, self.mean)
