"""Builtins that need the arm's masses and motor torques, which this emulation does not have.

The names exist, so that a client's program compiles; a call ends the program and says why.
"""

from typing import NoReturn

from hil.cell.arm.urscript.errors import ScriptError
from hil.cell.arm.urscript.values import Value


class Dynamics:
    @staticmethod
    def direct_torque(
        torque: Value,
        friction_comp: Value = True,
        viscous_scale: Value = None,
        coulomb_scale: Value = None,
    ) -> NoReturn:
        raise _missing("direct_torque")

    @staticmethod
    def get_mass_matrix(q: Value = "current", include_rotors_inertia: Value = True) -> NoReturn:
        raise _missing("get_mass_matrix")

    @staticmethod
    def get_coriolis_and_centrifugal_torques(
        q: Value = "current", qd: Value = "current"
    ) -> NoReturn:
        raise _missing("get_coriolis_and_centrifugal_torques")


def _missing(name: str) -> ScriptError:
    return ScriptError(f"{name} is not emulated: the arm has no mass model here")
