"""The MuJoCo model of a rig: options of the solver, and the parts put together."""

import mujoco

from hil.cell.errors import PlantError
from hil.cell.plant.mjcf_cable import add_cable
from hil.cell.plant.mjcf_connector import add_connector
from hil.cell.plant.mjcf_stage import add_sensor, add_stage
from hil.cell.plant.scenery import add_scenery
from hil.cell.rig import Rig


def build(rig: Rig, history: int) -> mujoco.MjModel:
    """Compile the model; its sensor keeps `history` physics steps. Raises PlantError, RigError."""
    spec = mujoco.MjSpec()
    spec.modelname = rig.name
    set_options(spec, rig.physics.step)
    add_scenery(spec, "connector")
    add_connector(spec, rig.connector)
    jaws = add_stage(spec, rig.tool, rig.cable, rig.robot.servo)
    add_cable(jaws, rig.cable, rig.pad, rig.connector)
    add_sensor(spec, history)
    try:
        return spec.compile()
    except ValueError as error:
        raise PlantError(f"MuJoCo cannot build rig {rig.name!r}: {error}") from error


def set_options(spec: mujoco.MjSpec, step: float) -> None:
    """Chosen by measurement; the defaults (Euler, pyramidal cone) creep and chatter."""
    spec.compiler.degree = False
    option = spec.option
    option.timestep = step
    option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    # Creep while sticking goes as 1 / impratio (0.92 um/s at 10, 0.46 at 20, 0.31 at 30), but at 30
    # the place where stick-slip comes to rest depends on the step (0.16 N at 0.5 ms; 0.08 at 20).
    option.impratio = 20.0
    option.tolerance = 1e-10
    option.ccd_tolerance = 1e-9
    # A model that resets itself on NaN would hide the fault: the plant looks and raises instead.
    option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
