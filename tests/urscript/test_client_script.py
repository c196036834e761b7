"""The control script that ur_rtde uploads, taken from the client itself: it is not ours to keep."""

import socket
import subprocess
import sys
from contextlib import ExitStack
from threading import Thread

import pytest

from drivers.protocol.rtde import Cutter, PackageType, encode
from drivers.protocol.rtde_setup import (
    ControllerVersion,
    decode_names,
    decode_names_with_frequency,
    encode_accepted,
    encode_controller_version,
    encode_types,
)
from hil.cell.arm.urscript import compile_program
from hil.cell.arm.urscript.parse import parse

HOST = "127.0.0.78"
"""The client's ports are fixed; an own loopback address keeps them apart from other cells'."""


def type_of(name: str) -> str:
    if name.startswith(("timestamp", "output_double", "input_double")):
        return "DOUBLE"
    if name == "external_force_torque":
        return "VECTOR6D"
    return "INT32" if name.startswith(("output_int", "input_int")) else "UINT32"


class Controller:
    """As much RTDE as the client needs before it uploads its script: every value is 0."""

    def __init__(self) -> None:
        self.recipes = 0
        self.data = b""

    def replies(self, package) -> list[bytes]:
        kind, payload = package
        if kind == PackageType.GET_CONTROLLER_VERSION:
            return [encode(kind, encode_controller_version(ControllerVersion(3, 15, 8, 0)))]
        if kind == PackageType.SETUP_OUTPUTS:
            types = [type_of(name) for name in decode_names_with_frequency(payload)[0]]
            size = sum({"DOUBLE": 8, "VECTOR6D": 48}.get(t, 4) for t in types)
            self.data = encode(PackageType.DATA, b"\x01" + bytes(size))
            return [encode(kind, encode_types(types, 1))]
        if kind == PackageType.SETUP_INPUTS:
            self.recipes += 1
            types = [type_of(name) for name in decode_names(payload)]
            return [encode(kind, encode_types(types, self.recipes))]
        if kind == PackageType.DATA:
            return []
        reply = encode(kind, encode_accepted(True))
        return [reply, self.data, self.data] if kind == PackageType.START else [reply]


def serve_rtde(listener: socket.socket) -> None:
    connection, _ = listener.accept()
    controller, cutter = Controller(), Cutter()
    with connection:
        while received := connection.recv(65536):
            for package in cutter.feed(received):
                connection.sendall(b"".join(controller.replies(package)))


def greet(listener: socket.socket) -> None:
    connection, _ = listener.accept()
    with connection:
        connection.sendall(b"Connected: Universal Robots Dashboard Server\n")
        while connection.recv(4096):
            pass


def serving(serve, listener: socket.socket) -> Thread:
    def until_gone() -> None:
        try:
            serve(listener)
        except OSError:
            return  # the client is killed once its script is here

    thread = Thread(target=until_gone)
    thread.start()
    return thread


@pytest.fixture(scope="module")
def control_script() -> str:
    pytest.importorskip("rtde_control")
    with ExitStack() as stack:
        doors = [
            stack.enter_context(socket.create_server((HOST, port)))
            for port in (30004, 29999, 30003)
        ]
        threads = [serving(serve_rtde, doors[0]), serving(greet, doors[1])]
        connect = f"import rtde_control; rtde_control.RTDEControlInterface({HOST!r})"
        client = stack.enter_context(
            subprocess.Popen([sys.executable, "-c", connect], stderr=subprocess.DEVNULL)
        )
        doors[2].settimeout(20)
        connection, _ = doors[2].accept()
        with connection:
            connection.settimeout(20)
            text = b""
            while not text.rstrip().endswith(b"\nend"):
                text += connection.recv(65536)
        client.kill()
        for thread in threads:
            thread.join()
    return text.decode()


def test_control_script_parses(control_script):
    tree = parse(control_script)
    assert len(list(tree.find_data("thread"))) == 8
    assert len(list(tree.find_data("run"))) == 14


def test_control_script_compiles_for_its_software(control_script):
    program = compile_program(control_script, (3, 15, 8, 0))
    assert program.name == "rtde_control"
