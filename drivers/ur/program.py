"""The motion program that runs on the controller: its parameters, commands and states."""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import IntEnum
from importlib.resources import files
from string import Template

from drivers.interfaces import Vector6

SEQUENCE_MASK = 0x7FFFFFFF
"""Sequence numbers live in a signed 32-bit register and wrap to 0."""


class Command(IntEnum):
    """What the program is told in input_int_register_24."""

    HOLD = 0
    SERVO = 1
    STOP = 2
    LEAVE = 3


class ProgramState(IntEnum):
    """What the program says in output_int_register_25."""

    ENDED = 0
    STANDING = 1
    SERVOING = 2
    SILENCE = 3


@dataclass(frozen=True, slots=True)
class ServoProgram:
    """Parameters of the uploaded program.

    tcp: TCP in the flange's frame, m and rad. mass: kg. centre_of_gravity: in the flange's frame,
    m. lookahead: s, 0.03..0.2. gain: 100..2000 (script manual, servoj). deceleration: of a stop,
    rad/s^2. silence: s after which the robot stops by itself for want of a fresh command; one is
    as old as the package that it answers, and followed up to half of that age. step, turn: how far
    the arm is led towards a set-point in one control period at most, m and rad.
    """

    tcp: Vector6 = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    mass: float = 0.0
    centre_of_gravity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    lookahead: float = 0.03
    gain: float = 300.0
    deceleration: float = 4.0
    silence: float = 0.2
    step: float = 3e-3
    turn: float = 0.02

    def __post_init__(self) -> None:
        _within("lookahead", self.lookahead, 0.03, 0.2)
        _within("gain", self.gain, 100.0, 2000.0)
        _within("mass", self.mass, 0.0, 50.0)
        _within("deceleration", self.deceleration, 0.1, 40.0)
        _within("silence", self.silence, 0.02, 2.0)
        _within("step", self.step, 1e-6, 0.1)
        _within("turn", self.turn, 1e-6, 1.0)

    def text(self, rate: int) -> str:
        """The URScript for a controller of this rate, Hz."""
        patience = round(self.silence * rate)
        source = files("drivers.ur").joinpath("servo.script").read_text(encoding="ascii")
        return Template(source).substitute(
            tcp=_numbers(self.tcp),
            mass=_numbers([self.mass]),
            cog=_numbers(self.centre_of_gravity),
            lookahead=_numbers([self.lookahead]),
            gain=_numbers([self.gain]),
            deceleration=_numbers([self.deceleration]),
            step=_numbers([self.step]),
            turn=_numbers([self.turn]),
            patience=patience,
            late=patience // 2,
            silence=round(self.silence * 1e3),
        )


def _within(name: str, value: float, low: float, high: float) -> None:
    if not low <= value <= high:
        raise ValueError(f"{name} is {value}, allowed is {low}..{high}")


def _numbers(values: Iterable[float]) -> str:
    """Decimals without exponent, to the nanometre."""
    return ", ".join(f"{value:.9f}" for value in values)
