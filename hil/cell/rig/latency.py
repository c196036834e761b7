"""Delay laws of a link: how long a message travels, drawn from a seeded stream."""

from typing import Literal

import numpy as np
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
        if self.mean < 0 or self.jitter < 0:
            raise ValueError(f"mean {self.mean} s and jitter {self.jitter} s must not be negative")
        if self.law == "gamma" and not (self.mean > 0 and self.jitter > 0):
            raise ValueError("a gamma law needs a mean and a jitter above 0 s")
        return self

    def draw(self, rng: np.random.Generator) -> int:
        """One delay, ns."""
        if self.law == "constant" or self.jitter == 0.0:
            return round(self.mean * NS)
        if self.law == "uniform":
            seconds = rng.uniform(self.mean - self.jitter, self.mean + self.jitter)
        elif self.law == "normal":
            seconds = rng.normal(self.mean, self.jitter)
        else:
            shape = (self.mean / self.jitter) ** 2
            seconds = rng.gamma(shape, self.mean / shape)
        return max(0, round(seconds * NS))
