"""Rig sections of the job and of the limits that the near side's guard enforces."""

from typing import Literal

from pydantic import Field

from hil.cell.rig.latency import LatencyLaw
from hil.cell.rig.quantity import Angle, Length, MetresPerSecond, NewtonMetres, Newtons, Seconds
from hil.cell.rig.section import Section


class Limits(Section):
    """What ends a run safely. force_bound is the paper's f_b on |fx|, |fy|, |fz|, |tau_z|."""

    force_bound: tuple[Newtons, Newtons, Newtons, NewtonMetres] = (1.5, 1.5, 10.0, 1.0)
    workspace: tuple[Length, Length, Length] = (0.4, 0.4, 0.3)
    """Half widths around the connector, base frame."""
    step: Length = Field(default=3e-3, gt=0)
    """Largest set-point change of one period."""
    step_rotation: Angle = Field(default=0.02, gt=0)
    speed: MetresPerSecond = Field(default=0.3, gt=0)
    sample_age: Seconds = Field(default=10e-3, gt=0)
    """W: the newest sample's age that is still controlled on. Ten samples; by then a descent at
    4 mm/s has gone 0.04 mm, 0.8 N at the pad's 20 kN/m."""
    mass_error: float = Field(default=0.2, gt=0, lt=1)
    """Share of tool.mass by which the mass that a shaken sensor feels may be off before a job. As
    far off as a scale may be with the true force within f_b and `force_error`; gain and crosstalk
    of a sound sensor come to a third of it."""
    drift: Newtons = Field(default=5.0, gt=0)
    """Largest force in free air that a zeroing before a contact takes away. Half the bound along z,
    which is as far as a sound sensor with a part in the jaws never comes."""
    following: Length = Field(default=0.05, gt=0)
    """How far the arm may be from the last set-point: three times its lag at the fastest travel,
    0.15 m/s and 0.1 s. A slowed or hindered arm is stopped before it has more to catch up with."""
    command_age: Seconds = Field(default=0.1, ge=0.02, le=2)
    """X: age of a command's ground at which the robot stops by itself, and the near side when it
    hears so; up to half of it a command is followed, the rest is for coming to rest. Several times
    the round trip of any network that can be controlled over."""
    unanswered: Seconds = Field(default=0.15, ge=0.02, le=2)
    """How long the robot's program may echo no new command until the host calls its link to it
    dead, has the dashboard stop the program, and stops. X and half again: first the robot's own
    watchdog has its say, and a robot that has none is still noticed."""
    standstill: Seconds = Field(default=0.5, gt=0)
    """N, as time: from a fault that has to stop the arm until it stands. X, a stop at 4 rad/s^2
    from the fastest travel (0.1 s) and the arm's own lag (50 ms), twice."""
    connect_tries: int = Field(default=3, ge=1, le=20)
    """Attempts at an RTDE link that is refused or cut at the start, 0.1 s apart, then 0.2 s and so
    on. Three bridge a controller whose server just comes up; more would hide a wrong address."""
    force_error: float = Field(default=0.25, ge=0)
    """How far the sensor may be off, as a share of force_bound: noise of the mean, drift since the
    last zero and travel time of a sample at search speed. What the true force is judged with."""


class Task(Section):
    """The insertion: contact force, the six actions' sizes, goal, and where episodes start."""

    contact_force: Newtons = Field(default=5.0, gt=0)
    step: Length = Field(default=0.3e-3, gt=0)
    step_rotation: Angle = Field(default=0.0174532925199433, gt=0)
    goal_depth: Length = Field(default=2.0e-3, gt=0)
    max_steps: int = Field(default=500, ge=1)
    start_cells: tuple[int, int, int] = (8, 8, 6)
    """Half widths of the start's uniform draw in x, y, theta, in steps."""
    search_cells: tuple[int, int, int] = (10, 10, 8)
    """Half widths of the search box in x, y, theta, in steps; a step out of it is not taken."""
    clearance: Length = 5e-3
    """Height above the face at which the approach begins."""
    on_jam: Literal["draw out", "step on"] = "draw out"
    """What follows a part stuck in the slot's mouth: lift it and touch again, or step where it is
    (the paper's learner)."""

    max_jams: int = Field(default=20, ge=0)
    """How often a stuck part may be drawn out in one episode. Sound searches need it a few times;
    a blocked slot would go on to `max_steps`, for minutes."""


class Link(Section):
    """Delays of one link, by direction."""

    to_cell: LatencyLaw = LatencyLaw()
    from_cell: LatencyLaw = LatencyLaw()


class Latency(Section):
    """Delays in bench time, the same in both clocks."""

    rtde: Link = Link()
    can: Link = Link()
    sensor_tcp: Link = Link()
