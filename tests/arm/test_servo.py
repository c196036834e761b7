"""The servo follows, brakes and holds."""

import math

from hypothesis import given
from hypothesis import strategies as st

from hil.cell.arm.servo import STOP_DECELERATION, Servo

HOME = (0.0, -1.5, 1.5, -1.5, -1.5, 0.0)
DT = 0.008


def moved(q, step):
    return tuple(angle + step for angle in q)


def test_a_servo_follows_its_set_point_at_once():
    servo = Servo(HOME, DT)
    servo.command(moved(HOME, 0.008))
    servo.advance()
    assert servo.q == moved(HOME, 0.008)
    assert all(math.isclose(speed, 1.0) for speed in servo.qd)


def test_the_last_set_point_of_a_cycle_wins():
    servo = Servo(HOME, DT)
    servo.command(moved(HOME, 0.001))
    servo.command(moved(HOME, 0.002))
    servo.advance()
    assert servo.q == moved(HOME, 0.002)


def test_a_servo_without_set_points_holds():
    servo = Servo(HOME, DT)
    for _ in range(5):
        servo.advance()
    assert servo.q == HOME


@given(st.floats(-0.02, 0.02), st.floats(1.0, 40.0))
def test_braking_never_reverses_and_ends_at_rest(step, deceleration):
    servo = Servo(HOME, DT)
    servo.command(moved(HOME, step))
    servo.advance()
    cycles = 0
    stands = False
    while not stands:
        before = servo.qd[0]
        stands = servo.brake(deceleration)
        servo.advance()
        cycles += 1
        assert abs(servo.qd[0]) <= abs(before) + 1e-12
        assert servo.qd[0] * step >= -1e-9
    assert cycles <= math.ceil(abs(step) / DT / (deceleration * DT)) + 1


def test_a_program_that_stops_commanding_in_motion_stops_within_the_category_two_distance():
    servo = Servo(HOME, DT)
    servo.command(moved(HOME, 0.02))
    servo.advance()
    speed, start = servo.qd[0], servo.q[0]
    for _ in range(100):
        servo.advance()
    assert 0 < servo.q[0] - start <= speed**2 / (2 * STOP_DECELERATION)
