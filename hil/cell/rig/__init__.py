"""The rig file and its sections."""

from hil.cell.rig.latency import LatencyLaw
from hil.cell.rig.rig import Rig, drawn, load, parse

__all__ = ["LatencyLaw", "Rig", "drawn", "load", "parse"]
