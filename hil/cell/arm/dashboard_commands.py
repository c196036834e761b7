"""What each dashboard command does to the control box, and its exact reply.

First versions: UR's dashboard manuals for CB3 and e-Series.
"""

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Final, NamedTuple, TypeAlias

from drivers.protocol.primary_messages import Popup
from drivers.protocol.rtde_states import RuntimeState
from hil.cell.arm.controller import ArmController
from hil.cell.arm.modes import Event
from hil.cell.arm.pendant import DEFAULT_INSTALLATION, ROLES, UNNAMED

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
    """Go on with a paused program, or start the loaded one from its beginning."""
    script = arm.box.pendant.script
    started = arm.box.post(Event.RESUME) or (script is not None and arm.programs.play(script))
    return "Starting program" if started else "Failed to execute: play"


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


def _load(arm: ArmController, path: str) -> str:
    """Loading ends the loaded program, as it does on the pendant."""
    if not arm.box.pendant.load(path):
        return f"File not found: {path}"
    if arm.programs.on_pendant:
        arm.programs.stop()
    return f"Loading program: {path}"


def _load_installation(arm: ArmController, path: str) -> str:
    found = path.rpartition("/")[2] == DEFAULT_INSTALLATION
    return f"Loading installation: {path}" if found else f"File not found: {path}"


def _loaded_program(arm: ArmController, argument: str) -> str:
    program = arm.box.pendant.program
    return "No program loaded" if program == UNNAMED else f"Loaded program: /programs/{program}"


def _is_saved(arm: ArmController, argument: str) -> str:
    program = arm.box.pendant.program
    return f"{str(program != UNNAMED).lower()} {program}"


def _state(arm: ArmController) -> RuntimeState:
    """Of the pendant's own program: URSim says STOPPED while one sent by socket runs."""
    return arm.box.modes.program if arm.programs.on_pendant else RuntimeState.STOPPED


def _running(arm: ArmController, argument: str) -> str:
    return f"Program running: {str(_state(arm) is RuntimeState.PLAYING).lower()}"


def _program_state(arm: ArmController, argument: str) -> str:
    return f"{_state(arm).name} {arm.box.pendant.program}"


def _popup(arm: ArmController, text: str) -> str:
    arm.box.say(f"popup: {text}")
    arm.box.announce(Popup("Message", text))
    return "showing popup"


def _set_role(arm: ArmController, role: str) -> str:
    if role.upper() not in ROLES:
        return f"Failed setting user role: {role}"
    arm.box.pendant.role = role.upper()
    return f"Setting user role: {role}"


def _role(arm: ArmController, argument: str) -> str:
    return arm.box.pendant.role


def _set_mode(arm: ArmController, mode: str) -> str:
    if mode.upper() not in ("MANUAL", "AUTOMATIC"):
        return f"Failed setting operational mode: '{mode}'"
    arm.box.pendant.operational_mode = mode.upper()
    return f"Operational mode {mode.upper()} is set"


def _mode(arm: ArmController, argument: str) -> str:
    return arm.box.pendant.operational_mode


def _clear_mode(arm: ArmController, argument: str) -> str:
    arm.box.pendant.operational_mode = "NONE"
    return "No longer controlling the operational mode. Current operational mode: 'NONE'."


def _in_remote_control(arm: ArmController, argument: str) -> str:
    return str(arm.box.robot.remote_control).lower()


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


COMMANDS: Final[Mapping[str, Command]] = MappingProxyType(
    {
        "load installation": Command(_load_installation, (3, 2)),
        "load": Command(_load),
        "play": Command(_play),
        "stop": Command(_stop),
        "pause": Command(_pause),
        "quit": Command(_says("Disconnected")),
        "shutdown": Command(_posts(Event.POWER_OFF, "Shutting down")),
        "running": Command(_running),
        "robotmode": Command(_robot_mode),
        "get loaded program": Command(_loaded_program),
        "popup": Command(_popup),
        "close popup": Command(_says("closing popup")),
        "addtolog": Command(_add_to_log),
        "isprogramsaved": Command(_is_saved),
        "programstate": Command(_program_state),
        "polyscopeversion": Command(_polyscope_version),
        "version": Command(_version, None),
        "set operational mode": Command(_set_mode, None),
        "get operational mode": Command(_mode, None, (5, 6)),
        "clear operational mode": Command(_clear_mode, None),
        "setuserrole": Command(_set_role, (3, 1), None),
        "getuserrole": Command(_role, (3, 1), None),
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
        "is in remote control": Command(_in_remote_control, None, (5, 6)),
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
