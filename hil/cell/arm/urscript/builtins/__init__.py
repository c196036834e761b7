"""The builtin functions, by topic: every public method of a topic is a builtin of that name.

A builtin exists when it can act on the robot through its port; any other name is refused when
the program is compiled, as the controller does.
"""

from collections.abc import Callable, Mapping
from functools import cache
from inspect import Parameter, Signature, isgeneratorfunction, signature
from typing import Final

from hil.cell.arm.port import RobotPort
from hil.cell.arm.urscript.builtins.configuration import Configuration
from hil.cell.arm.urscript.builtins.drive import Drive
from hil.cell.arm.urscript.builtins.dynamics import Dynamics
from hil.cell.arm.urscript.builtins.forces import Forces
from hil.cell.arm.urscript.builtins.kinematics import Kinematics
from hil.cell.arm.urscript.builtins.maths import Maths
from hil.cell.arm.urscript.builtins.matrices import Matrices
from hil.cell.arm.urscript.builtins.motion import Motion
from hil.cell.arm.urscript.builtins.poses import Poses
from hil.cell.arm.urscript.builtins.queries import Queries
from hil.cell.arm.urscript.builtins.registers import Registers
from hil.cell.arm.urscript.builtins.servoing import Servoing
from hil.cell.arm.urscript.builtins.setup import Setup
from hil.cell.arm.urscript.builtins.sockets import SocketCalls
from hil.cell.arm.urscript.builtins.speed import Speed
from hil.cell.arm.urscript.builtins.strings import Strings
from hil.cell.arm.urscript.builtins.timing import Timing
from hil.cell.arm.urscript.builtins.versions import NEWEST, Version, known
from hil.cell.arm.urscript.symbols import Builtin, builtin

_TOPICS: Final = (
    Configuration, Dynamics, Forces, Kinematics, Maths, Matrices, Motion, Poses, Queries, Registers,
    Servoing, Setup, SocketCalls, Speed, Strings, Timing,
)  # fmt: skip


def _names(topic: type) -> list[str]:
    return [name for name in vars(topic) if not name.startswith("_")]


@cache
def builtins(version: Version = NEWEST) -> Mapping[str, Builtin]:
    """The builtins of a software version by their URScript name."""
    return {
        name: _described(name, getattr(topic, name))
        for topic in _TOPICS
        for name in _names(topic)
        if known(name, version)
    }


def _described(name: str, function: Callable[..., object]) -> Builtin:
    parameters = [p for p in signature(function).parameters.values() if p.name != "self"]
    assert all(p.kind is Parameter.POSITIONAL_OR_KEYWORD for p in parameters)
    return Builtin(builtin(name), Signature(parameters), isgeneratorfunction(function))


def bind(port: RobotPort, claim: Callable[[], None]) -> dict[str, object]:
    """Every builtin by its compiled name, acting on `port`; `claim` takes the robot for a cycle."""
    drive = Drive(port, claim)
    topics: tuple[object, ...] = (
        Configuration(port), Dynamics(), Forces(port), Kinematics(port), Maths(), Matrices(),
        Motion(drive), Poses(), Queries(port), Registers(port), Servoing(drive), Setup(port),
        SocketCalls(port), Speed(drive), Strings(), Timing(port),
    )  # fmt: skip
    return {builtin(name): getattr(topic, name) for topic in topics for name in _names(type(topic))}
