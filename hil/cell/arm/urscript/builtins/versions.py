"""Which software brought which builtin: one that a version does not know is a compile error.

From UR's client library and ur_rtde, which leave these calls out for older software. Names that
UR's external control uses on every version, used or not, exist on every version.
"""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final, TypeAlias

Version: TypeAlias = tuple[int, ...]

NEWEST: Final[Version] = (99,)
"""Knows everything."""

_FIRST_E_SERIES: Final = 5
_NEVER: Final[Version] = (_FIRST_E_SERIES,)

_ADDED: Final[Mapping[str, tuple[Version, Version]]] = MappingProxyType(
    {
        "set_target_payload": ((3, 15), (5, 10)),
        "get_target_payload_inertia": ((3, 15), (5, 10)),
        "transpose": ((3, 14), (5, 9)),
        "inv": ((3, 14), (5, 9)),
        "size": ((3, 14), (5, 9)),
        "get_freedrive_status": (_NEVER, (5, 0)),
        "freedrive_mode_no_incorrect_payload_check": (_NEVER, (5, 0)),
        "set_tool_output_mode": (_NEVER, (5, 0)),
        "set_tool_digital_output_mode": (_NEVER, (5, 0)),
        "set_tool_communication": (_NEVER, (5, 0)),
        "optimovej": (_NEVER, (5, 21)),
        "optimovel": (_NEVER, (5, 21)),
        "get_jacobian": (_NEVER, (5, 22)),
        "get_jacobian_time_derivative": (_NEVER, (5, 22)),
        "get_mass_matrix": (_NEVER, (5, 22)),
        "get_coriolis_and_centrifugal_torques": (_NEVER, (5, 22)),
        "get_target_joint_accelerations": (_NEVER, (5, 22)),
        "direct_torque": (_NEVER, (5, 23)),
    }
)
"""First CB3 and first e-Series version, by name."""


def known(name: str, version: Version) -> bool:
    """Whether that software has the builtin."""
    added = _ADDED.get(name)
    return added is None or version >= added[version[0] >= _FIRST_E_SERIES]
