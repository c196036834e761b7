"""What each dashboard command does to the control box, and its exact reply.

First versions: UR's dashboard manuals for CB3 and e-Series.
"""

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Final, NamedTuple, TypeAlias

from drivers.protocol.rtde_states import RuntimeState
from hil.cell.arm.controller import ArmController
from hil.cell.arm.modes import Event

Reply: TypeAlias = Callable[[ArmController, str], str]

SERIAL_NUMBER: Final = "20000000001"
"""Marks an emulated box: real serial numbers begin with the year of make, and no arm is of 2000."""

_UNLOCK_REFUSED: Final = (
    "Cannot unlock protective stop until 5s after occurrence. "
    "Always inspect cause of protective stop before unlocking"
)


class Command(NamedTuple):
    """reply: by box and argument. cb3, e_series: first version with it, None for never."""

    reply: Reply
    cb3: tuple[int, int] | None = (1, 4)
    e_series: tuple[int, int] | None = (5, 0)

    def known_to(self, version: tuple[int, ...]) -> bool:
        first = self.cb3 if version[0] < 5 else self.e_series
        return first is not None and version[:2] >= first


def _says(text: str) -> Reply:
    return lambda arm, argument: text


def _posts(event: Event, text: str) -> Reply:
    """The dashboard confirms the wish; whether the modes follow, `robotmode` tells."""

    def reply(arm: ArmController, argument: str) -> str:
        arm.box.post(event)
        return text

    return reply


def _play(arm: ArmController, argument: str) -> str:
    """There are no program files, so only a paused program can be played."""
    return "Starting program" if arm.box.post(Event.RESUME) else "Failed to execute: play"


def _pause(arm: ArmController, argument: str) -> str:
    return "Pausing program" if arm.box.post(Event.PAUSE) else "Failed to execute: pause"


def _stop(arm: ArmController, argument: str) -> str:
    arm.programs.stop()
    return "Stopped"


def _unlock(arm: ArmController, argument: str) -> str:
    if not arm.box.modes.unlockable(arm.box.t):
        return _UNLOCK_REFUSED
    arm.box.post(Event.UNLOCK)
    return "Protective stop releasing"


def _add_to_log(arm: ArmController, argument: str) -> str:
    arm.box.say(argument)
    return "Added log message"


def _running(arm: ArmController, argument: str) -> str:
    playing = arm.box.modes.program is RuntimeState.PLAYING
    return f"Program running: {str(playing).lower()}"


def _program_state(arm: ArmController, argument: str) -> str:
    return f"{arm.box.modes.program.name} <unnamed>"


def _version(arm: ArmController, argument: str) -> str:
    return arm.box.robot.version


def _polyscope_version(arm: ArmController, argument: str) -> str:
    return f"URSoftware {arm.box.robot.version} (Jun 20 2022)"


def _model(arm: ArmController, argument: str) -> str:
    return arm.box.robot.model.removesuffix("e").upper()


def _robot_mode(arm: ArmController, argument: str) -> str:
    return f"Robotmode: {arm.box.modes.robot.name}"


def _safety_mode(arm: ArmController, argument: str) -> str:
    return f"Safetymode: {arm.box.modes.safety.name}"


def _safety_status(arm: ArmController, argument: str) -> str:
    return f"Safetystatus: {arm.box.modes.safety.name}"


def _not_found(arm: ArmController, argument: str) -> str:
    return f"File not found: {argument}"


COMMANDS: Final[Mapping[str, Command]] = MappingProxyType(
    {
        "load installation": Command(_not_found, (3, 2)),
        "load": Command(_not_found),
        "play": Command(_play),
        "stop": Command(_stop),
        "pause": Command(_pause),
        "quit": Command(_says("Disconnected")),
        "shutdown": Command(_posts(Event.POWER_OFF, "Shutting down")),
        "running": Command(_running),
        "robotmode": Command(_robot_mode),
        "get loaded program": Command(_says("No program loaded")),
        "popup": Command(_says("showing popup")),
        "close popup": Command(_says("closing popup")),
        "addtolog": Command(_add_to_log),
        "isprogramsaved": Command(_says("false <unnamed>")),
        "programstate": Command(_program_state),
        "polyscopeversion": Command(_polyscope_version),
        "version": Command(_version, None),
        "set operational mode manual": Command(_says("Operational mode MANUAL is set"), None),
        "set operational mode automatic": Command(_says("Operational mode AUTOMATIC is set"), None),
        "get operational mode": Command(_says("NONE"), None, (5, 6)),
        "clear operational mode": Command(
            _says("No longer controlling the operational mode. Current operational mode: 'NONE'."),
            None,
        ),
        "setuserrole": Command(lambda arm, role: f"Setting user role: {role}", (3, 1), None),
        "getuserrole": Command(_says("NONE"), (3, 1), None),
        "power on": Command(_posts(Event.POWER_ON, "Powering on"), (3, 0)),
        "power off": Command(_posts(Event.POWER_OFF, "Powering off"), (3, 0)),
        "brake release": Command(_posts(Event.BRAKE_RELEASE, "Brake releasing"), (3, 0)),
        "safetymode": Command(_safety_mode, (3, 0)),
        "safetystatus": Command(_safety_status, (3, 11), (5, 4)),
        "unlock protective stop": Command(_unlock, (3, 1)),
        "close safety popup": Command(_says("closing safety popup"), (3, 1)),
        "restart safety": Command(
            _posts(Event.RESTART_SAFETY, "Restarting safety"), (3, 7), (5, 1)
        ),
        "is in remote control": Command(_says("true"), None, (5, 6)),
        "get serial number": Command(_says(SERIAL_NUMBER), (3, 12), (5, 6)),
        "get robot model": Command(_model, (3, 12), (5, 6)),
        "generate flight report": Command(
            _says("Flight Report generated with id:1"), (3, 13), (5, 8)
        ),
        "generate support file": Command(
            _says("Completed successfully: emulated_support_file.zip"), (3, 13), (5, 8)
        ),
        "savelog": Command(_says("Log saved to disk"), (3, 13)),
    }
)
"""By name in lower case; a name may be followed by one space and an argument."""
