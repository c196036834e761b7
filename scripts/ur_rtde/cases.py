"""All rows: which cases an interface of ur_rtde has, and which of its methods have none."""

import dashboard_cases
import force_cases
import io_cases
import motion_cases
import program_cases
import receive_cases
import script_cases
import state_cases
from case import Case, Cases
from dashboard_client import DashboardClient
from rtde_control import RTDEControlInterface
from rtde_io import RTDEIOInterface
from rtde_receive import RTDEReceiveInterface
from script_client import ScriptClient

CONTROL: Cases = {
    **motion_cases.CASES,
    **force_cases.CASES,
    **state_cases.CASES,
    **program_cases.CASES,
}
INTERFACES: dict[type, Cases] = {
    RTDEControlInterface: CONTROL,
    RTDEReceiveInterface: receive_cases.CASES,
    RTDEIOInterface: io_cases.CASES,
    DashboardClient: dashboard_cases.CASES,
    ScriptClient: script_cases.CASES,
}
QUICK = (
    "moveJ", "moveL", "getAsyncOperationProgress", "servoJ", "speedL",
    "stopJ", "jogStart", "forceMode", "zeroFtSensor", "moveUntilContact", "setTcp",
    "getInverseKinematics", "getForwardKinematics (joints and TCP)", "isSteady", "teachMode",
    "sendCustomScriptFunction", "reconnect",
)  # fmt: skip
"""Control calls of every kind, for a check of a minute."""


def rows() -> dict[str, Case]:
    """Every case by `Interface.method`, in the table's order."""
    return {
        f"{interface.__name__}.{name}": case
        for interface, cases in INTERFACES.items()
        for name, case in cases.items()
    }


def quick() -> list[str]:
    """The small selection: some control calls, all readings and outputs but the slow ones."""
    return [row for row in rows() if row.partition(".")[2] in QUICK and "Control" in row] + [
        row for row in rows() if row.startswith("RTDEIOInterface")
    ]


def methods(interface: type) -> set[str]:
    """The public methods of a client's class, as installed."""
    return {
        name
        for name in dir(interface)
        if not name.startswith("_")
        and callable(member := getattr(interface, name))
        and not isinstance(member, type)
    }


def without_a_row() -> list[str]:
    """Methods of the installed client that no case tests."""
    return [
        f"{interface.__name__}.{name}"
        for interface, cases in INTERFACES.items()
        for name in sorted(methods(interface) - {row.partition(" ")[0] for row in cases})
    ]


def of_no_method() -> list[str]:
    """Cases whose method the installed client does not have."""
    return [
        f"{interface.__name__}.{row}"
        for interface, cases in INTERFACES.items()
        for row in cases
        if row.partition(" ")[0] not in methods(interface)
    ]
