"""The flat cable as a beam: section stiffnesses and the hinges that stand for them."""

from math import pi

from hil.cell.rig.parts import Cable


def bending_rigidity(cable: Cable) -> float:
    """EI about the long side of the section, N·m^2."""
    return cable.modulus * cable.width * cable.thickness**3 / 12


def torsional_rigidity(cable: Cable) -> float:
    """GJ of a thin rectangle, N·m^2."""
    shear_modulus = cable.modulus / (2 * (1 + cable.poisson))
    return shear_modulus * cable.width * cable.thickness**3 / 3


def tip_stiffness(cable: Cable) -> float:
    """Lateral force per deflection of the clamped cable's tip, 3 EI / L^3, N/m."""
    return 3 * bending_rigidity(cable) / cable.free_length**3


def twist_stiffness(cable: Cable) -> float:
    """Torque per twist of the tip, N·m/rad: St. Venant plus restrained warping at the jaws.

    A clamped wide strip cannot warp; its halves bend against each other on the lever width/2,
    which adds tip_stiffness times the second moment of the width, w^2/12.
    """
    free = torsional_rigidity(cable) / cable.free_length
    return free + tip_stiffness(cable) * cable.width**2 / 12


def bending_hinge(cable: Cable, index: int) -> float:
    """Stiffness of the index-th bending hinge from the jaws, N·m/rad.

    The hinge at the jaws stands for half a segment of beam, so it is twice as stiff.
    """
    segment = cable.free_length / cable.segments
    return bending_rigidity(cable) / segment * (2.0 if index == 0 else 1.0)


def twist_hinge(cable: Cable) -> float:
    """Stiffness of each of the torsion hinges in series, N·m/rad."""
    return twist_stiffness(cable) * cable.segments


def euler_load(cable: Cable) -> float:
    """Buckling load with the tip held sideways by friction (fixed-pinned), N."""
    return 2.0457 * pi**2 * bending_rigidity(cable) / cable.free_length**2
