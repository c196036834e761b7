"""Whether the CAN controller may be trusted, from its error frames and the frames after them."""

from typing import Final

from drivers.protocol.can_error import BusState, ErrorFrame

GOOD_FRAMES: Final = 64
"""Frames without a fault between them that end a fault: four 125 Hz periods of paired samples."""

_FAULTS: Final = frozenset((BusState.PASSIVE, BusState.OFF))


class Confinement:
    """A fault lasts until the controller has left error-passive or bus-off and, after that, the
    bus has carried GOOD_FRAMES: a loose connector comes and goes.

    A controller that hears frames is back on the bus, so bus-off needs no notice to end; an
    error-passive one hears as well as ever, so its state stands until the kernel takes it back.
    """

    def __init__(self) -> None:
        self.state = BusState.ACTIVE
        self.owed = 0
        self._cause = BusState.ACTIVE

    def hear(self, frame: ErrorFrame) -> None:
        """Take an error frame, in bus order with the frames of `credit`."""
        if frame.state is None:
            return
        self.state = frame.state
        if frame.state in _FAULTS:
            self.owed, self._cause = GOOD_FRAMES, frame.state

    def credit(self, frames: int) -> None:
        """So many frames came and no error frame with or after them."""
        if self.state is BusState.OFF and frames:
            self.state = BusState.ACTIVE
        if self.state is not BusState.PASSIVE:
            self.owed = max(0, self.owed - frames)

    def restart(self) -> None:
        """The interface was opened anew, which starts a controller error-active unsaid."""
        self.state = BusState.ACTIVE

    @property
    def fault(self) -> str:
        """Why nothing may be controlled on what this bus carries; "" when it may."""
        if not self.owed:
            return ""
        if self.state in _FAULTS:
            return f"CAN controller is {self.state}"
        carried = GOOD_FRAMES - self.owed
        return f"CAN bus has carried {carried} of {GOOD_FRAMES} frames since {self._cause}"
