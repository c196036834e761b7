"""G1, G2 and P1 to P4: the gripper, the part and what it meets."""

from typing import Final

from hil.cell.faults.row import HOLDING, TOUCHING, Parameter, Phase, Place, Row, word

PART: Final = (
    Row(
        "G1", "part.slip", "Part slips or is dropped", Place.GRIPPER,
        (word("what", "drop", "slip"), Parameter("slip", 1e-3, "m", -0.01, 0.01)),
        "notice by force or width, abort the episode, no insertion with empty hands",
        "reason of the abort; no motion into the connector",
        phases=HOLDING, lasting=False,
    ),
    Row(
        "G2", "gripper.silent", "Gripper does not respond, or stops half-way", Place.GRIPPER,
        (word("what", "dead", "half", "late"), Parameter("delay", 0.5, "s", 0.0, 60.0)),
        "time-out; no move with the part's place unknown",
        "time-out event",
        phases=(Phase.FREE, Phase.INSERT),
    ),
    Row(
        "P1", "plant.pose", "Connector off its place", Place.PLANT,
        (
            Parameter("dx", 0.5e-3, "m", -0.02, 0.02),
            Parameter("dy", 0.3e-3, "m", -0.02, 0.02),
            Parameter("rotation", 0.0, "rad", -0.2, 0.2),
            Parameter("speed", 20e-3, "m/s", 1e-4, 1.0),
        ),
        "search within its box, abort at k_max",
        "force bound; steps at most k_max",
    ),
    Row(
        "P2", "plant.stiffness", "Stiffness or friction changed", Place.PLANT,
        (Parameter("stiffness", 3.0, "", 0.01, 6.0), Parameter("friction", 1.0, "", 0.0, 10.0)),
        "adaptive gains converge, no overshoot beyond f_b",
        "overshoot; gains bounded",
        phases=TOUCHING,
    ),
    Row(
        "P3", "plant.blocked", "Connector blocked, or the cable kinked", Place.PLANT,
        (
            word("what", "blocked", "kink"),
            Parameter("depth", 0.5e-3, "m", 0.0, 0.01),
            Parameter("angle", 0.2, "rad", -1.0, 1.0),
        ),
        "abort at the force bound, mark as danger, at most k retries",
        "peak force, retries",
        phases=(Phase.SEARCH, Phase.INSERT),
    ),
    Row(
        "P4", "plant.collision", "Unexpected collision", Place.PLANT,
        (
            Parameter("below", 0.5e-3, "m", 0.0, 0.1),
            Parameter("stiffness", 20e3, "N/m", 1.0, 50e3),
        ),
        "stop, retract along the approach",
        "contact in a free phase; standstill within N",
        phases=(Phase.FREE, Phase.APPROACH),
    ),
)  # fmt: skip
