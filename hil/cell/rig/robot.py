"""Rig sections of the arm, its servo, its gripper and its safety limits."""

from pathlib import Path
from typing import Literal

from pydantic import Field, model_validator

from hil.cell.rig.quantity import (
    Angle,
    Hertz,
    Length,
    MetresPerSecond,
    Newtons,
    Radians,
    RadiansPerSecond,
    Seconds,
)  # fmt: skip
from hil.cell.rig.section import Section

Model = Literal[
    "ur3", "ur5", "ur10", "ur3e", "ur5e", "ur7e", "ur10e", "ur12e", "ur16e", "ur15", "ur18",
    "ur20", "ur30", "ur8long",
]  # fmt: skip


class Ports(Section):
    """TCP ports; 0 takes a free one and the cell says which."""

    dashboard: int = Field(default=29999, ge=0, le=65535)
    primary: int = Field(default=30001, ge=0, le=65535)
    secondary: int = Field(default=30002, ge=0, le=65535)
    realtime: int = Field(default=30003, ge=0, le=65535)
    rtde: int = Field(default=30004, ge=0, le=65535)


FIRST_E_SERIES = 5
"""First major software version of the e-Series."""

FREE_PORTS = Ports(dashboard=0, primary=0, secondary=0, realtime=0, rtde=0)


class Servo(Section):
    """How the arm follows set-points: a critically damped second-order lag, as measured in
    contact-free tracking (22 Hz gives a ramp lag of 14.5 ms).
    """

    bandwidth: Hertz = Field(default=22.0, gt=0)


class Safety(Section):
    """Limits of the robot's own safety system; beyond one it makes a protective stop."""

    joint_speed: RadiansPerSecond = Field(default=3.1415926535897931, gt=0)
    tcp_speed: MetresPerSecond = Field(default=1.0, gt=0)
    tcp_force: Newtons = Field(default=250.0, gt=0)
    """What the tool may press or be pressed with: the least restricted setting of a box."""
    joint_range: Angle = 6.2831853071795862
    servo_step: Angle = 0.05
    """Largest joint set-point jump of one control period."""


class Jaws(Section):
    """Pneumatic jaws on one digital output, with a grip sensor on one digital input."""

    output: int = Field(default=0, ge=0, le=7)
    sensed: int = Field(default=0, ge=0, le=7)
    close_delay: Seconds = 0.08
    open_delay: Seconds = 0.06
    sense_delay: Seconds = 0.02


class Robot(Section):
    """The arm: model, controller series and software version, and what hangs on it."""

    model: Model = "ur5"
    series: Literal["cb3", "e-series"] = "cb3"
    version: str = Field(default="3.15.8.106339", pattern=r"^\d+\.\d+\.\d+\.\d+$")
    host: str = "127.0.0.1"
    ports: Ports = Ports()
    remote_control: bool = True
    """What an e-Series dashboard says of itself; commands are obeyed either way."""
    programs: Path | None = None
    """Folder of the programs that the dashboard can load, each a .script; none unless given."""
    repeatability: Length = 0.03e-3
    """Half width of the true pose's offset from the reported one, drawn anew at every grip."""
    home: tuple[Radians, Radians, Radians, Radians, Radians, Radians] = (
        0.0,
        -1.7174039840276597,
        2.0751965473559977,
        -1.9285888901232345,
        -1.5707963267948966,
        1.5707963267948966,
    )
    """Joint angles at power-up: the tool points down, beside the connector."""
    servo: Servo = Servo()
    safety: Safety = Safety()
    jaws: Jaws = Jaws()

    @model_validator(mode="after")
    def _version_of_series(self) -> "Robot":
        """CB3 runs software 3.x, the e-Series 5.x and later."""
        if (self.series == "cb3") != (int(self.version.partition(".")[0]) < FIRST_E_SERIES):
            raise ValueError(
                f"version {self.version} does not run on series {self.series}; "
                "cb3 has 3.x (3.15.8.106339), e-series 5.x and later (5.11.0.108249)"
            )
        return self

    @property
    def rate(self) -> int:
        """Control rate of the series, Hz (CB3 125, e-Series 500)."""
        return 125 if self.series == "cb3" else 500

    @property
    def period(self) -> int:
        """Control period, ns."""
        return 1_000_000_000 // self.rate
