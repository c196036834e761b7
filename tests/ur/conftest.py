"""A robot of few words: RTDE, dashboard and script ports behind real sockets, no physics.

It advances one period for each command, as the emulated cell does in lockstep. Tests set its
attributes while it waits for a command, that is between a `read` and the next command.
"""

import selectors
import socket
import struct
import threading
from contextlib import suppress

import pytest

from drivers.protocol import rtde_setup as setup
from drivers.protocol.dashboard import GREETING
from drivers.protocol.rtde import Cutter, PackageType, Recipe, encode
from drivers.protocol.rtde_variables import INPUTS, OUTPUTS
from drivers.ur.arm import UrPorts

DOORS = ("dashboard", "script", "rtde")


class TinyRobot:
    def __init__(self):
        self.version = setup.ControllerVersion(3, 15, 8, 106339)
        self.verdicts = {}  # field name -> NOT_FOUND or IN_USE
        self.protocol_accepted = self.start_accepted = True
        self.t = 100.0
        self.period = 0.008
        self.robot_mode, self.safety_mode, self.runtime_state = 3, 1, 1
        self.pose = (0.4, -0.1, 0.2, 0.0, 3.1, 0.0)
        self.twist = (0.0,) * 6
        self.echo, self.program, self.cycle = 57, 2, 900  # left behind by an earlier program
        self.starts_programs = True
        self.silent = False
        self.deaf = False  # its program goes on, and no command reaches it
        self.extra = b""  # sent before each data package
        self.after = lambda: b""  # what is sent after it
        self.turns_away = 0  # how many RTDE clients it closes the door on
        self.clients = 0
        self.refusals = 0  # how often `unlock protective stop` is refused
        self.commands, self.scripts, self.dashboard_lines = [], [], []

    # one period

    def step(self, values):
        self.commands.append(values)
        command, sequence = values[0], values[1]
        self.t += self.period
        self.robot_mode = {4: 5, 6: 7}.get(self.robot_mode, self.robot_mode)
        if self.runtime_state == 2 and not self.deaf:
            self.echo, self.program = sequence, 2 if command == 1 else 1
            self.cycle += 1
            if command == 3:
                self.runtime_state, self.program = 1, 0
            if command == 1:
                self.pose = values[2:8]

    def values(self):
        zero = (0.0,) * 6
        return (
            *(self.t, zero, self.pose, self.pose, self.twist),
            *(self.robot_mode, self.safety_mode, self.runtime_state, 0b100, 0),
            *(self.echo, self.program, self.cycle),
        )

    # the three doors

    def script(self, text):
        self.scripts.append(text)
        if self.starts_programs and text.endswith("end\n"):
            self.start()

    def start(self):
        self.runtime_state, self.cycle = 2, 0

    def dashboard(self, line):
        self.dashboard_lines.append(line)
        if line == "power on":
            self.robot_mode = 4
            return "Powering on"
        if line == "brake release":
            self.robot_mode = 6
            return "Brake releasing"
        if line == "stop":
            self.runtime_state = 1
            return "Stopped"
        if line == "unlock protective stop" and self.refusals:
            self.refusals -= 1
            return "Cannot unlock protective stop until 5s after occurrence. Always inspect cause"
        if line == "unlock protective stop":
            self.safety_mode = 1
            return "Protective stop releasing"
        return f"could not understand: '{line}'"

    def rtde(self, package):
        kind, payload = package
        if kind == PackageType.REQUEST_PROTOCOL_VERSION:
            return encode(kind, setup.encode_accepted(self.protocol_accepted))
        if kind == PackageType.GET_CONTROLLER_VERSION:
            return encode(kind, setup.encode_controller_version(self.version))
        if kind == PackageType.SETUP_OUTPUTS:
            names, self.frequency = setup.decode_names_with_frequency(payload)
            self.out_recipe = Recipe(names, [OUTPUTS[name].type for name in names])
            return encode(kind, self._types(OUTPUTS, names))
        if kind == PackageType.SETUP_INPUTS:
            names = setup.decode_names(payload)
            self.in_recipe = Recipe(names, [INPUTS[name].type for name in names])
            return encode(kind, self._types(INPUTS, names))
        if kind == PackageType.START:
            return encode(kind, setup.encode_accepted(self.start_accepted))
        self.step(self.in_recipe.unpack(payload[1:]))
        body = self.out_recipe.pack(self.values())
        package = self.extra + encode(PackageType.DATA, b"\x01" + body) + self.after()
        return b"" if self.silent else package

    def _types(self, table, names):
        types = [self.verdicts.get(name, table[name].type.name) for name in names]
        return setup.encode_types(types, 0 if set(types) & set(self.verdicts.values()) else 1)


class Served:
    """A TinyRobot in a thread; `cut` resets the RTDE link as a dying controller does."""

    def __init__(self, robot):
        self.robot = robot
        self._selector = selectors.DefaultSelector()
        self._listeners = {}
        self._clients = {}
        for door in DOORS:
            listener = self._listeners[door] = socket.create_server(("127.0.0.1", 0))
            self._selector.register(listener, selectors.EVENT_READ, (door, None))
        self._ours, self._theirs = socket.socketpair()
        self._selector.register(self._theirs, selectors.EVENT_READ, ("", None))
        self._thread = threading.Thread(target=self._run)

    @property
    def ports(self):
        port = {door: listener.getsockname()[1] for door, listener in self._listeners.items()}
        return UrPorts(port["rtde"], port["dashboard"], port["script"])

    def cut(self):
        self._ours.sendall(b"c")
        assert self._ours.recv(1) == b"c"

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._ours.sendall(b"q")
        self._thread.join()
        for held in (*self._listeners.values(), *self._clients, self._ours, self._theirs):
            held.close()
        self._selector.close()

    def _run(self):
        while True:
            # Doors in their order, so that what was sent before a command is heard before it.
            ready = sorted((key for key, _ in self._selector.select()), key=lambda k: order(k.data))
            for key in ready:
                door, state = key.data
                if not door:
                    if self._theirs.recv(1) == b"q":
                        return
                    self._reset()
                elif state is None:
                    self._accept(door, key.fileobj)
                else:
                    self._serve(door, key.fileobj, state)

    def _accept(self, door, listener):
        client, _ = listener.accept()
        self.robot.clients += door == "rtde"
        if door == "rtde" and self.robot.clients <= self.robot.turns_away:
            client.close()
            return
        client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._clients[client] = door
        state = Cutter() if door == "rtde" else [b""]
        self._selector.register(client, selectors.EVENT_READ, (door, state))
        if door == "dashboard":
            client.sendall(GREETING.encode() + b"\n")

    def _serve(self, door, client, state):
        received = b""
        with suppress(ConnectionError):
            received = client.recv(65536)
        if not received:
            return self._leave(client)
        if door == "rtde":
            client.sendall(b"".join(self.robot.rtde(p) for p in state.feed(received)))
        elif door == "script":
            self.robot.script(received.decode())
        else:
            *lines, state[0] = (state[0] + received).split(b"\n")
            for line in lines:
                client.sendall(self.robot.dashboard(line.decode()).encode() + b"\n")
        return None

    def _leave(self, client):
        self._selector.unregister(client)
        del self._clients[client]
        client.close()

    def _reset(self):
        for client in [c for c, door in self._clients.items() if door == "rtde"]:
            linger = struct.pack("ii", 1, 0)  # close with a reset
            client.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, linger)
            self._leave(client)
        self._theirs.sendall(b"c")


def order(tag):
    return DOORS.index(tag[0]) if tag[0] else -1


@pytest.fixture
def robot():
    return TinyRobot()


@pytest.fixture
def served(robot):
    with Served(robot) as door:
        yield door
