"""Real devices in the place of a cell: the same near side, at the addresses of the rig."""

from typing import Self

from drivers.protocol.bus_address import BusAddress
from hil.app.cell import CellReport
from hil.app.tap import Entry
from hil.cell.errors import CellError, RigError
from hil.cell.plant.interface import PlantStep
from hil.cell.rig import Rig
from hil.cell.serve import Doors


def doors(rig: Rig) -> Doors:
    """Where a rig says that its devices are, emulated ones by its fixed ports."""
    tcp, robot = rig.sensor.tcp, rig.robot
    sensor = (tcp.host or robot.host, tcp.port) if rig.sensor.serves_tcp else None
    address = BusAddress(rig.can.interface, rig.can.channel)
    return Doors(robot.host, robot.ports.model_dump(), address, sensor)


class RealCell:
    """Opens and owns nothing: the drivers connect. RigError for a clock that is not the wall's."""

    live = True

    def __init__(self, rig: Rig, clock: str) -> None:
        if clock != "wall":
            raise RigError(f"rig '{rig.name}' is real: it runs by the wall clock, not {clock}")
        self._rig = rig

    @property
    def doors(self) -> Doors:
        return doors(self._rig)

    @property
    def description(self) -> str:
        where = self.doors
        wire = f"CAN {where.can.interface} {where.can.channel}".rstrip()
        if self._rig.sensor.wire == "tcp" and where.sensor is not None:
            wire = "TCP {}:{}".format(*where.sensor)
        robot = self._rig.robot
        return f"real devices: {robot.model} ({robot.series}) at {where.host}, sensor on {wire}"

    def truth(self) -> PlantStep:
        """Not to be had: a real cell has no true wrench at hand."""
        raise CellError("a real cell's truth is unknown; run against an emulated rig")

    def take(self) -> list[Entry]:
        """Nothing: what happened inside is not ours to see."""
        return []

    def note(self, phase: str, episode: int) -> None:
        """Faults are for emulated cells."""
        raise CellError("a real cell cannot be told to fail")

    def leave(self, duration: int) -> None:
        """Nothing here can be emulated."""
        raise CellError("a real cell cannot be told to fail")

    def stop(self) -> CellReport:
        """Leaves the devices alone; the drivers have stopped the arm."""
        return CellReport(0, None, ())

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        return None
