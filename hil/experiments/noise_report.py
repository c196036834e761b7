"""How noisy the emulated sensor is, beside what its preset says: one long record over the frames.

The node's frames are decoded by the driver's codec, so range, resolution and wire scale are in the
answer. The sensor is taken warm and unfiltered: warm-up and filter
are deterministic and would hide the rest.
"""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.signal import welch  # type: ignore[attr-defined]  # re-exported beyond mypy's sight

from drivers.protocol.nrs_can import Identifiers
from drivers.protocol.nrs_command import Command, Opcode, encode_command
from drivers.protocol.nrs_sample import decode_fd, decode_pair
from hil.cell.rig import LatencyLaw, Rig
from hil.cell.rig.sensor import Sensor
from hil.cell.sensor.node import SensorNode
from hil.cell.sensor.transducer import RATE, error_budget
from hil.experiments.allan import allan_deviation

Array = NDArray[np.float64]

AXES: Final = ("fx", "fy", "fz", "tx", "ty", "tz")
TAUS: Final = (0.01, 0.1, 1.0, 10.0)
BLOCK: Final = 1000
"""Milliseconds advanced at once."""
DELAYS: Final = 20_000


@dataclass(frozen=True, slots=True)
class Measured:
    """One number against what the preset makes of it."""

    value: float
    expected: float

    @property
    def ratio(self) -> float:
        return self.value / self.expected if self.expected else math.inf


@dataclass(frozen=True, slots=True)
class AxisNoise:
    """sigma: of first differences over sqrt 2, N or N·m. psd: one-sided, 20 .. 400 Hz, per Hz.
    step: smallest step between two readings. allan: at each of TAUS that the record allows.
    """

    sigma: Measured
    psd: Measured
    step: Measured
    allan: tuple[Measured, ...]


@dataclass(frozen=True, slots=True)
class DelayNoise:
    """Delays drawn from the rig's law of sensor frames, s; expected is before clipping at 0."""

    law: LatencyLaw
    mean: Measured
    jitter: Measured
    delays: Array


@dataclass(frozen=True, slots=True)
class NoiseReport:
    """axes in the order of AXES; records: the readings, (n, 6), N and N·m."""

    seed: int
    seconds: float
    axes: tuple[AxisNoise, ...]
    delay: DelayNoise
    record: Array


def measure(rig: Rig, seed: int, seconds: float = 200.0) -> NoiseReport:
    """Record for so many seconds of bench time, then put the preset's numbers beside it."""
    node_rng, delay_rng = np.random.default_rng(seed).spawn(2)
    readings = record(rig.sensor, node_rng, seconds)
    axes = tuple(_axis(readings[:, axis], rig.sensor, torque=axis >= 3) for axis in range(6))
    return NoiseReport(seed, seconds, axes, _delay(rig.latency.can.from_cell, delay_rng), readings)


def record(sensor: Sensor, rng: np.random.Generator, seconds: float) -> Array:
    """Readings of an unloaded, warm sensor sending every millisecond, (n, 6)."""
    warm = sensor.errors.model_copy(update={"warm_up_force": 0.0, "warm_up_torque": 0.0})
    sensor = sensor.model_copy(update={"errors": warm, "rate": float(RATE), "filter_cutoff": 0.0})
    node = SensorNode(sensor, rng)
    ids = Identifiers.of(sensor.node)
    idle = np.zeros((BLOCK, 6))
    node.advance(BLOCK * 1_000_000, idle)
    node.receive(encode_command(ids, Command(Opcode.TRANSMIT, 1, (1,))), BLOCK * 1_000_000)
    force: list[bytes] = []
    torque: list[bytes] = []
    whole: list[bytes] = []
    sinks = {ids.force: force, ids.torque: torque, ids.wrench_fd: whole}
    for block in range(2, 2 + math.ceil(seconds * 1000 / BLOCK)):
        for _, frame in node.advance(block * BLOCK * 1_000_000, idle):
            if frame.id in sinks:
                sinks[frame.id].append(frame.data)
    if sensor.frames == "fd":
        return np.array([decode_fd(ids, octets).wrench for octets in whole])
    # The last FORCE may be on its way without its TORQUE.
    pairs = zip(force, torque, strict=False)
    return np.array([decode_pair(*pair).wrench for pair in pairs])


def _axis(readings: Array, sensor: Sensor, torque: bool) -> AxisNoise:
    errors = error_budget(sensor)
    resolution = sensor.resolution_torque if torque else sensor.resolution_force
    white = errors.noise_torque if torque else errors.noise_force
    walk = errors.walk_torque if torque else errors.walk_force
    # Rounding adds a uniform error; a quiet sensor at rest dithers nothing and shows none.
    sigma = math.hypot(white, resolution / math.sqrt(12)) if white else 0.0
    frequencies, density = welch(readings, fs=RATE, nperseg=min(len(readings), 4096))
    flat = (frequencies >= 20.0) & (frequencies <= 400.0)
    steps = np.diff(np.unique(np.rint(readings / resolution)))
    return AxisNoise(
        sigma=Measured(float(np.std(np.diff(readings))) / math.sqrt(2), sigma),
        psd=Measured(float(np.mean(density[flat])), 2 * sigma**2 / RATE),
        step=Measured(float(steps.min(initial=math.inf)) * resolution, resolution),
        allan=tuple(
            Measured(allan_deviation(readings, RATE, tau), expected_allan(sigma, walk, tau))
            for tau in TAUS
            if len(readings) > 10 * tau * RATE
        ),
    )


def expected_allan(sigma: float, walk: float, tau: float) -> float:
    """White noise falls as 1/sqrt(tau), a walk of `walk` per sqrt(s) rises as sqrt(tau/3)."""
    return math.hypot(sigma / math.sqrt(tau * RATE), walk * math.sqrt(tau / 3))


def _delay(law: LatencyLaw, rng: np.random.Generator) -> DelayNoise:
    delays = np.array([law.draw(rng) for _ in range(DELAYS)]) * 1e-9
    spread = {"constant": 0.0, "uniform": law.jitter / math.sqrt(3)}.get(law.law, law.jitter)
    return DelayNoise(
        law=law,
        mean=Measured(float(delays.mean()), law.mean),
        jitter=Measured(float(delays.std()), spread),
        delays=delays,
    )
