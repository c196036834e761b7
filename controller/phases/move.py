"""Straight travel in free air with a trapezoidal speed profile."""

from math import dist, inf, sqrt

from controller.course import Course, Phase
from controller.cycle import Cycle
from controller.place import Place
from controller.ramp import line
from controller.settings import Travel


def move(course: Course, target: Place, travel: Travel) -> Phase[Cycle]:
    """Go from the last set-point to `target`, all axes together, and arrive exactly."""
    start = course.setpoint
    way, turn = dist(start[:3], target[:3]), abs(target.theta - start.theta)
    speed = min(_per(travel.speed, way), _per(travel.turn_speed, turn))
    acceleration = min(_per(travel.acceleration, way), _per(travel.turn_acceleration, turn))
    fraction, t = 0.0, 0.0
    while fraction < 1.0:
        t += course.period
        fraction = travelled(t, speed, acceleration)
        yield from course.to(line(start, target, fraction))
    return course.cycle


def via(course: Course, target: Place, travel: Travel) -> Phase[Cycle]:
    """Go up to the crossing height, across, and down to `target`."""
    height = max(travel.height, target.z)
    if course.setpoint.z < height:
        yield from move(course, course.setpoint.at(height), travel)
    yield from move(course, target.at(max(height, course.setpoint.z)), travel)
    return (yield from move(course, target, travel))


def travelled(t: float, speed: float, acceleration: float) -> float:
    """Fraction of a unit way done at t (s) under such limits (1/s, 1/s²), at most 1."""
    if speed == inf:
        return 1.0
    speed = min(speed, sqrt(acceleration))  # a short way never reaches full speed
    rise = speed / acceleration
    end = rise + 1.0 / speed
    if t >= end:
        return 1.0
    if t < rise:
        return 0.5 * acceleration * t * t
    if t > end - rise:
        return 1.0 - 0.5 * acceleration * (end - t) ** 2
    return speed * (t - 0.5 * rise)


def _per(limit: float, way: float) -> float:
    return limit / way if way > 0.0 else inf
