"""The curved surface in closed form: its height, and the force it puts on a tool's tip.

Scalars only: Python calls it, numba compiles it.
"""

from math import cos, pi, sin, sqrt
from typing import NamedTuple

from numba.extending import register_jitable

from hil.cell.rig.surface import Surface

STICTION_SPEED = 2e-3
"""Sliding speed, m/s, at which friction has reached 3/4 of Coulomb's; below, it is viscous."""


class Relief(NamedTuple):
    """Shape: height of the flat part, valley to crest, wavelength, extent along x; all m."""

    floor: float
    amplitude: float
    wavelength: float
    length: float


class Skin(NamedTuple):
    """What pressing meets: N/m, N s/m, -, and the push (N) beyond which another stiffness rules."""

    stiffness: float
    damping: float
    friction: float
    bottoming_force: float
    bottoming_stiffness: float


def relief_of(surface: Surface) -> Relief:
    return Relief(-surface.gap, surface.amplitude, surface.wavelength, surface.length)


def skin_of(surface: Surface) -> Skin:
    return Skin(
        surface.stiffness,
        surface.damping,
        surface.friction,
        surface.bottoming_force,
        surface.bottoming_stiffness,
    )


@register_jitable
def height_and_slope(relief: Relief, x: float) -> tuple[float, float]:
    """Surface z, m, and dz/dx at x."""
    if x <= 0.0:
        return relief.floor, 0.0
    w = 2.0 * pi / relief.wavelength
    angle = w * min(x, relief.length)
    rise = 0.5 * relief.amplitude
    slope = rise * w * sin(angle) if x < relief.length else 0.0
    return relief.floor + rise * (1.0 - cos(angle)), slope


@register_jitable
def spring(skin: Skin, depth: float) -> float:
    """Push of the surface at a depth along its normal, N; bilinear where it bottoms out."""
    push = skin.stiffness * depth
    if skin.bottoming_force > 0.0 and push > skin.bottoming_force:
        beyond = depth - skin.bottoming_force / skin.stiffness
        push = skin.bottoming_force + skin.bottoming_stiffness * beyond
    return push


@register_jitable
def contact_force(
    relief: Relief, skin: Skin, place: tuple[float, float], velocity: tuple[float, float]
) -> tuple[float, float]:
    """Force on a tip at (x, z) moving with (vx, vz), task frame, N; it pushes and never pulls."""
    height, slope = height_and_slope(relief, place[0])
    if place[1] >= height:
        return 0.0, 0.0
    c = 1.0 / sqrt(1.0 + slope * slope)
    s = slope * c
    outward = c * velocity[1] - s * velocity[0]
    push = max(0.0, spring(skin, (height - place[1]) * c) - skin.damping * outward)
    drag = friction(skin, push, c * velocity[0] + s * velocity[1])
    return -s * push - c * drag, c * push - s * drag


@register_jitable
def friction(skin: Skin, push: float, sliding: float) -> float:
    """What holds a tip back that is pressed with push (N) and slides so fast (m/s), N."""
    ratio = sliding / STICTION_SPEED
    return skin.friction * push * ratio / sqrt(1.0 + ratio * ratio)
