"""From the options of `hil run` to the run they ask for, and what it would do."""

from pathlib import Path
from typing import NamedTuple

import typer

from hil.app.near import part_named
from hil.app.real import doors
from hil.app.run import Request
from hil.cell.errors import FaultError, RigError
from hil.cell.faults.parse import load
from hil.cell.faults.schedule import Schedule
from hil.cell.injection.places import OF_A_RUN, check
from hil.cell.rig import Rig
from hil.cli.options import Clock, Layout, PolicyName
from hil.cli.shipped import read


class Choice(NamedTuple):
    """What the user chose; None leaves it to the rig."""

    seed: int | None
    layout: Layout
    clock: Clock | None
    policy: PolicyName
    part: str | None
    rig_ports: bool
    faults: Path | None = None


def rig_of(name: str, choice: Choice) -> tuple[Rig, bytes]:
    """The rig by file or name, and its text; RigError or BadParameter for what cannot be run."""
    found, text = read(name)
    if choice.policy is PolicyName.ORACLE and (
        choice.layout is Layout.PROCESS or found.rig == "real"
    ):
        raise typer.BadParameter(
            "oracle reads the plant's truth, which only --cell inline of an emulated rig has",
            param_hint="--policy",
        )
    if not found.fixture.parts:
        raise RigError(f"{name}: nothing to assemble; name a cable under fixture.parts")
    if found.rig == "real" and choice.clock is Clock.LOCKSTEP:
        raise typer.BadParameter(
            f"rig '{found.name}' is real; its devices keep the wall clock", param_hint="--clock"
        )
    return found if choice.rig_ports else found.on_free_ports(), text


def asked(rig: Rig, text: bytes, choice: Choice) -> Request:
    """The run, without a recording yet."""
    return Request(
        rig=rig,
        rig_text=text,
        seed=rig.seed if choice.seed is None else choice.seed,
        part=choice.part or rig.first_part,
        policy=choice.policy.value,
        layout=choice.layout.value,
        clock=choice.clock.value if choice.clock else rig.clock,
        alone=True,
        faults=None if choice.faults is None else scheduled(choice.faults, rig),
    )


def scheduled(file: Path, rig: Rig) -> Schedule:
    """The faults in a file; FaultError for one that an assembly on this rig has no place for."""
    schedule = load(file)
    try:
        check(tuple(enumerate(schedule.faults)), rig, OF_A_RUN)
    except FaultError as error:
        raise FaultError(f"{file}: {error}") from None
    return schedule


def plan_of(request: Request) -> dict[str, str | int | float | None]:
    """What a run would connect to and do; raises RigError for a part that is not there."""
    rig, where = request.rig, doors(request.rig)
    part = part_named(rig, request.part)
    real = rig.rig == "real"
    sensor = "{}:{}".format(*where.sensor) if rig.sensor.wire == "tcp" and where.sensor else ""
    bus = f"{where.can.interface} {where.can.channel or rig.can.context}".strip()
    bound = ", ".join(f"{value:g}" for value in rig.limits.force_bound)
    return {
        "rig": f"{rig.name} ({rig.rig})",
        "clock": request.clock,
        "robot": f"{rig.robot.model}, {rig.robot.series}, {rig.robot.version}",
        "robot at": _address(rig) if real else f"emulated, {request.layout}",
        "sensor": f"TCP {sensor}" if sensor else f"CAN {bus}, node {rig.sensor.node}",
        "part": f"{part.name} at ({_millimetres(part.position)}) mm",
        "connector": f"({_millimetres(rig.connector.position)}) mm",
        "self test": "the tool is shaken by 2 mm where it hangs",
        "policy": request.policy,
        "force bound": f"{bound} (N, N, N, N·m)",
        "speed limit": f"{rig.limits.speed * 1e3:g} mm/s",
        "moves": "the real arm" if real else "nothing real",
    }


def _address(rig: Rig) -> str:
    ports = rig.robot.ports
    named = f"RTDE {ports.rtde}, dashboard {ports.dashboard}, scripts {ports.secondary}"
    return f"{rig.robot.host}: {named}"


def _millimetres(position: tuple[float, float, float]) -> str:
    return ", ".join(f"{value * 1e3:g}" for value in position)
