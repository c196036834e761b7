"""Programs as TCP clients: the peer is a real listener, and time is the robot's own."""

import socket
from contextlib import closing

import pytest

from hil.cell.arm.urscript import RuntimeStatus


@pytest.fixture
def listener():
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(5)
        yield server


@pytest.fixture
def peer(listener, robot, start):
    """Start a program that has connected, and the other end of its connection."""

    def begin(body):
        port = listener.getsockname()[1]
        text = f'def client():\nok = socket_open("127.0.0.1", {port})\ntextmsg(ok)\n{body}\nend'
        runtime = start(text)
        step(runtime, robot)
        connection, _ = listener.accept()
        opened.append(connection)
        connection.settimeout(5)
        step(runtime, robot, 2)
        return runtime, connection

    opened = []
    yield begin
    for connection in opened:
        connection.close()


def step(runtime, robot, cycles=1):
    for _ in range(cycles):
        runtime.step()
        robot.end_cycle()


def test_numbers_and_text_go_out_as_the_manual_says(peer):
    _, connection = peer('socket_send_int(-2)\nsocket_send_byte(7)\nsocket_send_line("a")\nsync()')
    assert connection.recv(100) == b"\xff\xff\xff\xfe\x07a\n"


@pytest.mark.parametrize(
    ("call", "sent", "read"),
    [
        ("socket_read_binary_integer(2)", b"\0\0\0\1\xff\xff\xff\xff", "[2, 1, -1]"),
        ("socket_read_byte_list(3)", b"\1\2\xff", "[3, 1, 2, 255]"),
        ("socket_read_ascii_float(2)", b"(1.5, 2)", "[2, 1.5, 2]"),
        ("socket_read_line()", b"one\r\n", "one"),
        ('socket_read_string(prefix=">", suffix="<")', b"..>text<", "text"),
        ('socket_get_var("x")', b"x 42\n", "42"),
    ],
)
def test_a_read_waits_for_all_it_needs(peer, robot, call, sent, read):
    runtime, connection = peer(f"textmsg({call})")
    connection.sendall(sent[:-1])
    step(runtime, robot, 5)
    assert robot.messages == ["True"]
    connection.sendall(sent[-1:])
    step(runtime, robot, 1)
    assert robot.messages == ["True", read]


def test_a_read_times_out_in_robot_time(peer, robot):
    runtime, _ = peer("textmsg(socket_read_binary_integer(1, timeout = 0.08))")
    step(runtime, robot, 9)
    assert robot.messages == ["True"]
    step(runtime, robot, 3)
    assert robot.messages == ["True", "[0, -1]"]


def test_a_read_without_time_out_ends_when_the_peer_is_gone(peer, robot):
    runtime, connection = peer("textmsg(socket_read_binary_integer(1, timeout = 0))")
    step(runtime, robot, 500)
    assert robot.messages == ["True"]
    connection.close()
    step(runtime, robot, 2)
    assert robot.messages == ["True", "[0, -1]"]


def test_what_came_before_the_peer_left_is_still_read(peer, robot):
    runtime, connection = peer("sync()\nsync()\ntextmsg(socket_read_byte_list(2))")
    connection.sendall(b"\1\2")
    connection.close()
    step(runtime, robot, 5)
    assert robot.messages == ["True", "[2, 1, 2]"]


def test_nobody_listening_is_told_and_not_waited_for(robot, run):
    with closing(socket.socket()) as unused:
        unused.bind(("127.0.0.1", 0))
        port = unused.getsockname()[1]
        runtime = run(f'textmsg(socket_open("127.0.0.1", {port}))\ntextmsg(socket_send_int(1))')
    assert runtime.status is RuntimeStatus.FINISHED
    assert robot.messages == ["False", "False"]


def test_other_threads_run_while_one_waits_for_its_socket(peer, robot):
    runtime, _ = peer(
        'thread other():\nwhile True:\ntextmsg("t")\nsync()\nend\nend\n'
        "h = run other()\nenter_critical\nsocket_read_line(timeout = 0)\nexit_critical"
    )
    step(runtime, robot, 5)
    assert robot.messages.count("t") >= 4
