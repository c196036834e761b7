"""Rig sections of the force/torque sensor and its bus.

Presets carry the card's numbers (range, resolution) and typical strain-gauge errors; the vendor
publishes no error budget, so the second kind is this project's assumption, each term its own key.
"""

from typing import Literal

from pydantic import Field, field_validator, model_validator

from hil.cell.rig.quantity import BitsPerSecond, Hertz, NewtonMetres, Newtons, Seconds
from hil.cell.rig.section import Section


class Errors(Section):
    """Transducer errors, force and torque; 0 switches one off. Sigmas unless said otherwise."""

    noise_force: Newtons = 0.05
    noise_torque: NewtonMetres = 0.0008
    bias_force: Newtons = 5.0
    bias_torque: NewtonMetres = 0.1
    warm_up_force: Newtons = 1.5
    warm_up_torque: NewtonMetres = 0.03
    warm_up_time: Seconds = 900.0
    walk_force: Newtons = 0.005
    """Bias random walk, N per square root of a second."""
    walk_torque: NewtonMetres = 0.0001
    crosstalk: float = Field(default=0.01, ge=0, le=0.1)
    """Sigma of the off-diagonal calibration error, fraction of full scale per full scale."""
    gain: float = Field(default=0.01, ge=0, le=0.1)
    hysteresis: float = Field(default=0.005, ge=0, le=0.1)
    """Width as a fraction of the peak excursion."""
    clock_error: float = Field(default=50e-6, ge=0, le=1e-2)
    """Sample clock, half width, as a fraction."""


class SensorTcp(Section):
    """The sensor's TCP front, beside its CAN bus; port 0 takes a free one and the cell says which.

    host: where the emulated sensor listens, or where a real one is; "" is the robot's.
    """

    enabled: bool = False
    host: str = ""
    port: int = Field(default=2001, ge=0, le=65535)


class Sensor(Section):
    """The sensor: range, resolution, filter, errors, and how it talks."""

    wire: Literal["can", "tcp"] = "can"
    """What the driver reads the sensor over; `tcp` switches that front on."""
    preset: Literal["nrs-6050-d80", "nrs-6050-d80-quiet"] = "nrs-6050-d80"
    rate: Hertz = Field(default=1000.0, gt=0)
    range_force: Newtons = Field(default=500.0, gt=0)
    range_torque: NewtonMetres = Field(default=10.0, gt=0)
    resolution_force: Newtons = Field(default=0.015, gt=0)
    resolution_torque: NewtonMetres = Field(default=0.312e-3, gt=0)
    saturation: float = Field(default=1.2, ge=1.0, le=1.9)
    """Clipping point as a multiple of the range."""
    filter_cutoff: Hertz = 0.0
    """First-order low-pass; 0 Hz is off."""
    errors: Errors = Errors()
    frames: Literal["classic", "fd"] = "classic"
    node: int = Field(default=1, ge=1, le=15)
    boot_time: Seconds = 0.3
    tcp: SensorTcp = SensorTcp()
    flat_samples: int = Field(default=20, ge=0)
    """So many identical samples in a row are a stuck value to the driver; 0 switches it off."""
    blank_samples: int = Field(default=5, ge=0)
    """So many samples of zeros in a row are a dead sensor to the driver; 0 switches it off."""

    @field_validator("flat_samples", "blank_samples")
    @classmethod
    def _two_make_a_run(cls, samples: int) -> int:
        if samples == 1:
            raise ValueError("one sample is no run; take 0 for off, or at least 2")
        return samples

    @property
    def serves_tcp(self) -> bool:
        return self.tcp.enabled or self.wire == "tcp"

    def on_free_port(self) -> "Sensor":
        return self.model_copy(update={"tcp": self.tcp.model_copy(update={"port": 0})})


Interface = Literal[
    "auto", "config", "canalystii", "cantact", "etas", "gs_usb", "iscan", "ixxat", "kvaser",
    "neousys", "neovi", "nican", "nixnet", "pcan", "robotell", "seeedstudio", "serial", "slcan",
    "socketcan", "socketcand", "systec", "udp_multicast", "usb2can", "vector", "virtual",
]  # fmt: skip
"""python-can's back ends, and two of our own: `auto`, and `config` for python-can's own files."""


class CanBus(Section):
    """The python-can bus. `auto` takes socketcan where a CAN interface is up, else `virtual` in
    one process and `udp_multicast` between processes, and says which. `config` takes what
    python-can's configuration (~/.canrc, can.conf) says, from the section `context` first.
    """

    interface: Interface = "auto"
    channel: str = ""
    bitrate: BitsPerSecond = Field(default=1e6, gt=0)
    context: str = ""

    @model_validator(mode="after")
    def _context_belongs_to_config(self) -> "CanBus":
        if self.context and self.interface != "config":
            raise ValueError(f"context '{self.context}' is read with interface 'config' only")
        return self
