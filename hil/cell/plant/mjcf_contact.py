"""Contact between cable and connector in MuJoCo's words.

MuJoCo's defaults let a 5 N press sink 1 mm into the face. These were found by sweep: 0.1 um of
penetration, 0.4 um/s of creep while sticking.
"""

from typing import TypedDict

from hil.cell.rig.parts import Connector

CABLE, CONNECTOR = 1, 2
"""Collision bits; cable segments do not touch each other."""


class ContactOptions(TypedDict, total=False):
    """Keyword arguments of MjsBody.add_geom that make a geom touch."""

    contype: int
    conaffinity: int
    condim: int
    friction: list[float]
    solref: list[float]
    solimp: list[float]


def cable_side(connector: Connector) -> ContactOptions:
    return _options(connector, CABLE, CONNECTOR)


def connector_side(connector: Connector) -> ContactOptions:
    return _options(connector, CONNECTOR, CABLE)


def _options(connector: Connector, own: int, other: int) -> ContactOptions:
    return ContactOptions(
        contype=own,
        conaffinity=other,
        condim=3,
        friction=[connector.friction, 1e-4, 1e-5],
        solref=[2e-3, 1.0],
        solimp=[0.999, 0.999, 1e-5, 0.5, 2.0],
    )
