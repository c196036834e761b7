"""What a program can do wrong ends the program, with a place, and never the control box."""

import socket

import pytest

from hil.cell.arm.sockets import MAX_OPEN, Sockets
from hil.cell.arm.urscript import RuntimeStatus, ScriptError, compile_program


@pytest.mark.parametrize(
    ("statement", "complaint"),
    [
        ("rotvec2rpy([1])", "not enough values"),
        ("rpy2rotvec([0, 0, 0, 0])", "too many values"),
        ("pose_inv(p[0, 0, 0, 1e308 * 10, 0, 0])", "math domain error"),
        ('socket_open("127.0.0.1", 65536)', "port must be 0-65535"),
        ("socket_send_int(1e300)", "an integer of 32 bits was expected"),
        ("floor(1e300)", "integer overflow"),
        (f'to_num("{"9" * 400}")', "integer overflow"),
        ('to_num("1e999")', "is not a number"),
        ('to_num("²")', "is not a number"),
        ('to_str(["' + "x" * 600 + '", "' + "x" * 600 + '"])', "is longer than 1023"),
    ],
)
def test_a_value_that_makes_no_sense_is_the_programs_error(start, statement, complaint):
    runtime = start(f"def p():\n  {statement}\nend\n")
    for _ in range(3):
        runtime.step()
    assert runtime.status is RuntimeStatus.FAILED
    assert complaint in runtime.error.message
    assert runtime.error.line == 2


def test_a_host_name_that_cannot_be_one_is_not_reached(start, robot):
    runtime = start('def p():\n  textmsg(socket_open("..", 1))\nend\n')
    for _ in range(3):
        runtime.step()
    assert runtime.status is RuntimeStatus.FINISHED


def test_a_program_has_a_bounded_number_of_sockets():
    with socket.create_server(("127.0.0.1", 0), backlog=MAX_OPEN) as peer:
        sockets, address = Sockets(), peer.getsockname()
        for n in range(MAX_OPEN):
            sockets.open(f"s{n}", *address)
        sockets.open("s0", *address)
        with pytest.raises(ValueError, match=f"{MAX_OPEN} sockets are open"):
            sockets.open("one more", *address)
        sockets.close_all()


def test_a_number_of_many_digits_is_refused_with_its_place():
    with pytest.raises(ScriptError, match=r"line 2, column 6: number out of range: 9{40}$"):
        compile_program(f"def p():\n x = {'9' * 5000}\nend\n")
