"""Physical quantities in rig files: text with a unit in, a float in SI out."""

import math
import re
from functools import cache
from typing import Annotated, Final

import pint
from pydantic import BeforeValidator

_NUMBER: Final = r"[+-]?(?:(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?|(?:nan|inf)\b)"
_FACTOR: Final = r"[^\W\d]+(?:(?:\*\*|\^)-?\d)?"
_UNIT: Final = rf"°|{_FACTOR}(?:\s*[*/ ]\s*{_FACTOR})*"
_QUANTITY: Final = re.compile(rf"\s*({_NUMBER})\s*({_UNIT})\s*", re.IGNORECASE)
"""One decimal number and its unit. Pint alone would evaluate the text as an expression, in which
`18,5 mm` is 185 mm and `[1,2] m` is 12 m.
"""


@cache
def _registry() -> "pint.UnitRegistry[float]":
    return pint.UnitRegistry()


def parse(text: object, unit: str) -> float:
    """`text` ("18.5 mm") in SI `unit` ("m"); ValueError says what was found and what is allowed."""
    if not isinstance(text, str):
        raise ValueError(f"{text!r} has no unit; write a quantity such as '{text} {unit}'")
    match = _QUANTITY.fullmatch(text)
    if match is None:
        raise ValueError(f"{text!r} is not a number and a unit, such as '18.5 {unit}'")
    value = _converted(float(match[1]), match[2], unit)
    if not math.isfinite(value):
        raise ValueError(f"{text!r} is not finite")
    return value


def _converted(number: float, found: str, unit: str) -> float:
    try:
        return float(_registry().Quantity(number, found).to(unit).magnitude)
    except (pint.PintError, AssertionError, TypeError, ValueError) as error:
        raise ValueError(f"'{number:g} {found}' is not a quantity in {unit} ({error})") from None


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
