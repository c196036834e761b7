"""Physical quantities in rig files: text with a unit in, a float in SI out."""

import math
from functools import cache
from typing import Annotated

import pint
from pydantic import BeforeValidator


@cache
def _registry() -> "pint.UnitRegistry[float]":
    return pint.UnitRegistry()


def parse(text: object, unit: str) -> float:
    """`text` ("18.5 mm") in SI `unit` ("m"); ValueError says what was found and what is allowed."""
    if not isinstance(text, str):
        raise ValueError(f"{text!r} has no unit; write a quantity such as '{text} {unit}'")
    try:
        value = float(_registry().Quantity(text).to(unit).magnitude)
    except (pint.PintError, AssertionError, TypeError, ValueError) as error:
        raise ValueError(f"{text!r} is not a quantity in {unit} ({error})") from None
    if not math.isfinite(value):
        raise ValueError(f"{text!r} is not finite")
    return value


def _of(unit: str) -> BeforeValidator:
    return BeforeValidator(lambda text: parse(text, unit))


Metres = Annotated[float, _of("m")]
Radians = Annotated[float, _of("rad")]
Seconds = Annotated[float, _of("s")]
Newtons = Annotated[float, _of("N")]
NewtonMetres = Annotated[float, _of("N*m")]
Hertz = Annotated[float, _of("Hz")]
Kilograms = Annotated[float, _of("kg")]
Pascals = Annotated[float, _of("Pa")]
MetresPerSecond = Annotated[float, _of("m/s")]
RadiansPerSecond = Annotated[float, _of("rad/s")]
NewtonsPerMetre = Annotated[float, _of("N/m")]
NewtonMetresPerRadian = Annotated[float, _of("N*m/rad")]
NewtonSecondsPerMetre = Annotated[float, _of("N*s/m")]
BitsPerSecond = Annotated[float, _of("bit/s")]
Dimensionless = float
