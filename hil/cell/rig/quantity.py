"""Physical quantities in rig files: text with a unit in, a float in SI out."""

import math
import re
from functools import cache
from typing import Annotated, Final

import pint
from pydantic import BeforeValidator, Field

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
    try:
        value = float(_registry().Quantity(float(match[1]), match[2]).to(unit).magnitude)
    except (pint.PintError, AssertionError, TypeError, ValueError) as error:
        raise ValueError(f"{text!r} is not a quantity in {unit} ({error})") from None
    if not math.isfinite(value):
        raise ValueError(f"{text!r} is not finite")
    return value


def _of(unit: str) -> BeforeValidator:
    return BeforeValidator(lambda text: parse(text, unit))


Metres = Annotated[float, _of("m")]
Radians = Annotated[float, _of("rad")]
"""Of places and directions, which may be negative; what follows is a size and may not."""

Length = Annotated[Metres, Field(ge=0)]
Angle = Annotated[Radians, Field(ge=0)]
Seconds = Annotated[float, _of("s"), Field(ge=0)]
Newtons = Annotated[float, _of("N"), Field(ge=0)]
NewtonMetres = Annotated[float, _of("N*m"), Field(ge=0)]
Hertz = Annotated[float, _of("Hz"), Field(ge=0)]
Kilograms = Annotated[float, _of("kg"), Field(ge=0)]
Pascals = Annotated[float, _of("Pa"), Field(ge=0)]
MetresPerSecond = Annotated[float, _of("m/s"), Field(ge=0)]
RadiansPerSecond = Annotated[float, _of("rad/s"), Field(ge=0)]
NewtonsPerMetre = Annotated[float, _of("N/m"), Field(ge=0)]
NewtonMetresPerRadian = Annotated[float, _of("N*m/rad"), Field(ge=0)]
BitsPerSecond = Annotated[float, _of("bit/s"), Field(ge=0)]
