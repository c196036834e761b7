"""The connector as four convex prisms round a chamfered slot, and the slot's floor."""

import mujoco

from hil.cell.plant.mjcf_contact import connector_side
from hil.cell.rig.parts import Connector

FACE_X, FACE_Y = 15e-3, 8e-3
"""Half widths of the face, m (assumed; a cable beyond them falls past the housing)."""
BELOW = 3e-3
"""Housing below the slot's floor, m: thick, so that nothing tunnels through a thin wall."""
RGBA = [0.85, 0.83, 0.78, 1.0]


def add_connector(spec: mujoco.MjSpec, connector: Connector) -> None:
    """Put the connector into the world, the slot's mouth at the origin, facing +z."""
    body = spec.worldbody.add_body(name="connector")
    for name, vertices in walls(connector).items():
        spec.add_mesh(name=name, uservert=[c for vertex in vertices for c in vertex])
        body.add_geom(
            name=name, type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name, rgba=RGBA,
            **connector_side(connector),
        )  # fmt: skip
    body.add_geom(
        name="floor", type=mujoco.mjtGeom.mjGEOM_BOX, rgba=RGBA,
        pos=[0.0, 0.0, -connector.depth - BELOW / 2],
        size=[0.6 * connector.width, max(0.6 * connector.height, 1e-3), BELOW / 2],
        **connector_side(connector),
    )  # fmt: skip


def walls(connector: Connector) -> dict[str, list[tuple[float, float, float]]]:
    """Vertices of the four walls, m; each wall's inner edge at the face is a 45 degree chamfer."""
    across = {"wall_+x": 1, "wall_-x": -1}
    along = {"wall_+y": 1, "wall_-y": -1}
    section_x = _section(connector, connector.width / 2, FACE_X)
    section_y = _section(connector, connector.height / 2, FACE_Y)
    prisms = {n: [(s * u, v, z) for v in (-FACE_Y, FACE_Y) for u, z in section_x]
              for n, s in across.items()}  # fmt: skip
    prisms |= {n: [(v, s * u, z) for v in (-FACE_X, FACE_X) for u, z in section_y]
               for n, s in along.items()}  # fmt: skip
    return prisms


def _section(connector: Connector, inner: float, outer: float) -> list[tuple[float, float]]:
    """Cross-section of a wall: (distance from the slot's middle plane, z)."""
    bottom = -connector.depth - BELOW
    chamfer = connector.chamfer
    return [
        (inner, bottom),
        (outer, bottom),
        (outer, 0.0),
        (inner + chamfer, 0.0),
        (inner, -chamfer),
    ]
