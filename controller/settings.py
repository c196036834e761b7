"""The numbers of a job, grouped by the phase that uses them; SI units."""

from dataclasses import dataclass, field
from enum import Enum

from controller.place import Place


class Jam(Enum):
    """What follows when a part is stuck in the slot's mouth.

    DRAW_OUT: lift it out, take the next step in the air, touch again. STEP_ON: take the next step
    where it is, pressing, as the paper's learner does: quicker, and most of its dangers come so.
    """

    DRAW_OUT = "draw out"
    STEP_ON = "step on"


@dataclass(frozen=True, slots=True)
class Travel:
    """Motion in free air: m/s, m/s², rad/s, rad/s².

    The acceleration is what 0.6 kg of tool may push on the sensor: at 0.8 m/s² the 8 ms mean
    reaches 0.8 N (measured on the contact plant), half the lateral bound.
    """

    speed: float = 0.15
    acceleration: float = 0.8
    turn_speed: float = 0.6
    turn_acceleration: float = 3.0
    height: float = 0.03
    """Above the connector's face when crossing, m."""


@dataclass(frozen=True, slots=True)
class Press:
    """Contact along z: force f_d (N), m (N s²/m) and b (N s/m) of the admittance.

    stiffness: of cable and pad along z, N/m, for which b is right. descent: m/s. touch: N.
    tolerance: N, within which the force counts as settled. reach: m below the nominal face.
    """

    force: float = 5.0
    mass: float = 1.0
    damping: float = 1000.0
    stiffness: float = 16.5e3
    descent: float = 4e-3
    touch: float = 0.5
    tolerance: float = 0.15
    reach: float = 4e-3
    patience: float = 5.0
    """Longest wait for a settled force, s."""


@dataclass(frozen=True, slots=True)
class Search:
    """Search steps: sizes of Eq. 2 (m, rad), k_max, and how long one step rests.

    cells: half widths of the search box in steps of x, y, theta; a step out of it is not taken.
    entry: depth of the tip below the face (m) that only the slot's mouth allows. On the plain face
    the estimate stays below it; waiting for the slot proper, 0.3 mm, leaves a held cable between
    the mouth's walls, which pushed with up to 1.6 N (measured on the contact plant).
    """

    step: float = 0.3e-3
    step_rotation: float = 0.0174532925199433
    max_steps: int = 500
    cells: tuple[int, int, int] = (10, 10, 8)
    rest: float = 0.064
    longest_rest: float = 0.32
    force_band: float = 0.4
    speed_band: float = 0.4e-3
    entry: float = 0.1e-3


@dataclass(frozen=True, slots=True)
class Insertion:
    """Sliding in: goal depth of the tip (m), lateral nulling (N s/m, m/s), and when it is stuck.

    The cable lags 0.65 mm behind the jaws when it finds the slot and stores about 1 N; held
    laterally that load rises as the free length shortens (danger in 25 % of trials): null it.
    overtravel: m beyond the goal, for the error of the depth estimate.
    """

    goal_depth: float = 2.0e-3
    overtravel: float = 0.1e-3
    lateral_damping: float = 250.0
    lateral_speed: float = 5e-3
    stall: float = 0.5
    """Seconds without `progress` (m) that mean stuck."""
    progress: float = 0.05e-3
    jam: Jam = Jam.DRAW_OUT
    rest: float = 0.064
    """Seconds at rest (N, m/s) after which a part that is stepped on counts as stuck: waiting the
    whole stall would null each step's force before the next one."""
    force_band: float = 0.4
    speed_band: float = 0.4e-3
    jams: int = 20
    """How often a part may be drawn out in one episode; once more is a danger: what is blocked
    stays so however often it is pushed."""
    lift: float = 0.5e-3
    """Height above the face to which a stuck part is drawn out, m."""
    lift_speed: float = 5e-3


@dataclass(frozen=True, slots=True)
class Grip:
    """Jaws: approach height above the part (m), longest waits for them (s)."""

    height: float = 0.02
    wait: float = 0.5
    open_time: float = 0.1


@dataclass(frozen=True, slots=True)
class Plan:
    """One assembly: where the part lies, where the search starts, and the numbers of each phase.

    part: nominal tip of the waiting part. start: above the face, x, y, theta off by as much as the
    episode wants. Both in the task frame.
    """

    part: Place
    start: Place
    travel: Travel = field(default_factory=Travel)
    press: Press = field(default_factory=Press)
    search: Search = field(default_factory=Search)
    insertion: Insertion = field(default_factory=Insertion)
    grip: Grip = field(default_factory=Grip)
    tare_samples: int = 250
    """Samples of the zeroing before each contact; 0 keeps the tare of the start."""
    drift: float = 5.0
    """Largest force in free air that such a zeroing takes away, N."""
