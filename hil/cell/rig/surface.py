"""Rig section of the curved surface that force control is measured on (the paper's Fig. 5)."""

from pydantic import Field, model_validator

from hil.cell.rig.quantity import Length, Newtons, NewtonsPerMetre
from hil.cell.rig.section import Section


class Surface(Section):
    """A compliant surface below the task frame's origin, flat for x < 0 and wavy from there on.

    Its height is -gap + amplitude/2 (1 - cos(2 pi x/wavelength)): `amplitude` from valley to crest.
    The paper gives neither shape nor stiffness: all of them are assumed.
    """

    stiffness: NewtonsPerMetre = Field(default=10e3, gt=0)
    """k_e, along the surface's normal."""
    damping: float = Field(default=0.0, ge=0)
    """N s/m, along the normal; none is the hardest case for a force law."""
    friction: float = Field(default=0.2, ge=0, le=1)
    gap: Length = 5e-3
    """From x_c(0), the task frame's origin, down to the flat part."""
    amplitude: Length = 3e-3
    wavelength: Length = Field(default=80e-3, gt=0)
    length: Length = Field(default=0.4, gt=0)
    """How far the wavy part reaches; beyond it the surface is flat again, at its height there."""
    bottoming_force: Newtons = 0.0
    """Push beyond which the surface is as stiff as `bottoming_stiffness`; 0 N: it never is."""
    bottoming_stiffness: NewtonsPerMetre = Field(default=50e3, gt=0)

    @model_validator(mode="after")
    def _shallow(self) -> "Surface":
        """Force is controlled along z: on a slope near 45 degrees that is no longer the normal."""
        if 3.1416 * self.amplitude / self.wavelength > 0.6:
            raise ValueError(
                f"amplitude {self.amplitude:g} m on a wavelength of {self.wavelength:g} m is "
                "steeper than 0.6; take an amplitude below 0.19 wavelengths"
            )
        return self
