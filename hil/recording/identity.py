"""What a recording says about where it came from; everything in it is part of its digest."""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib.metadata import PackageNotFoundError, version

from hil.recording.channels.rtde import RecipeNames

VERSIONED = ("hil-testbed", "mujoco", "numpy", "python-can")
"""Packages whose version may change a run's numbers."""


@dataclass(frozen=True, slots=True)
class Identity:
    """Seed, rig and wire description of one run.

    rig: the rig file's bytes. dbc: the CAN database's bytes. settings: other choices that change
    the run, such as the policy; never a clock, a host, a path or the layout of processes.
    recipes_in, recipes_out: RTDE recipes by id, to decode data packages.
    """

    seed: int
    rig_name: str
    rig: bytes
    dbc: bytes = b""
    settings: Mapping[str, str] = field(default_factory=dict)
    recipes_in: Mapping[int, RecipeNames] = field(default_factory=dict)
    recipes_out: Mapping[int, RecipeNames] = field(default_factory=dict)

    def metadata(self) -> dict[str, str]:
        return {
            "seed": str(self.seed),
            "rig": self.rig_name,
            "rig_sha256": hashlib.sha256(self.rig).hexdigest(),
            **{key: self.settings[key] for key in sorted(self.settings)},
        }


def versions() -> dict[str, str]:
    """Versions of the packages that may change a run's numbers, "absent" for one not installed."""
    return {name: _version(name) for name in VERSIONED}


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "absent"
