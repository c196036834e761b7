"""The far side's error tree."""


class CellError(Exception):
    """Base of every error that the emulated cell raises."""


class RigError(CellError):
    """The rig file asks for something that does not exist or cannot be."""


class FaultError(RigError):
    """A fault, trigger or parameter that does not exist, or that this rig has no place for."""


class DoorError(CellError):
    """A port or bus could not be opened."""


class PlantError(CellError):
    """The physics left its domain: not finite, or a model that cannot be built."""
