"""The connector as four convex prisms round a chamfered slot, and the slot's floor."""

import mujoco

from hil.cell.plant.mjcf_contact import ContactOptions, connector_side
from hil.cell.rig.parts import Connector

FACE_X, FACE_Y = 15e-3, 8e-3
"""Half widths of the face, m (assumed; a cable beyond them falls past the housing)."""
BELOW = 3e-3
"""Housing below the slot's floor, m: thick, so that nothing tunnels through a thin wall."""
RGBA = [0.85, 0.83, 0.78, 1.0]


def add_connector(spec: mujoco.MjSpec, connector: Connector) -> None:
    """Put the connector into the world, the slot's mouth at the origin, facing +z."""
    body = spec.worldbody.add_body(name="connector")
    touching = connector_side(connector)
    half_x, half_y = connector.width / 2, connector.height / 2
    # Where the long walls are, the ends need not be: a second prism under the same tip would double
    # its contacts and a quarter of the physics' cost.
    end = half_y + connector.chamfer
    for sign in (-1, 1):
        along = _prism(_section(connector, half_y, FACE_Y), sign, FACE_X, turned=True)
        across = _prism(_section(connector, half_x, FACE_X), sign, end, turned=False)
        _add_wall(spec, body, f"wall_y{sign:+d}", along, touching)
        _add_wall(spec, body, f"wall_x{sign:+d}", across, touching)
    body.add_geom(
        name="floor", type=mujoco.mjtGeom.mjGEOM_BOX, rgba=RGBA,
        pos=[0.0, 0.0, -connector.depth - BELOW / 2],
        size=[0.6 * connector.width, max(0.6 * connector.height, 1e-3), BELOW / 2],
        **touching,
    )  # fmt: skip


def _add_wall(
    spec: mujoco.MjSpec, body: mujoco.MjsBody, name: str, vertices: list[float],
    contact: ContactOptions,
) -> None:  # fmt: skip
    spec.add_mesh(name=name, uservert=vertices)
    body.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name, rgba=RGBA, **contact)


def _prism(
    section: list[tuple[float, float]], sign: int, half_length: float, *, turned: bool
) -> list[float]:
    """Vertices of a wall: its section on one side of the slot, drawn out to both ends."""
    ends = (-half_length, half_length)
    if turned:
        return [c for v in ends for u, z in section for c in (v, sign * u, z)]
    return [c for v in ends for u, z in section for c in (sign * u, v, z)]


def _section(connector: Connector, inner: float, outer: float) -> list[tuple[float, float]]:
    """Cross-section of a wall with its 45 degree chamfer: (distance from the slot's middle, z)."""
    bottom = -connector.depth - BELOW
    chamfer = connector.chamfer
    return [
        (inner, bottom),
        (outer, bottom),
        (outer, 0.0),
        (inner + chamfer, 0.0),
        (inner, -chamfer),
    ]
