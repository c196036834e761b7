"""What a client of the primary, secondary or real-time port is sent, and when."""

from typing import Final, Protocol

from drivers.protocol.primary_messages import SafetyModeChange, Version, encode_message
from drivers.protocol.rtde_states import SafetyMode
from hil.cell.arm.box import ControlBox
from hil.cell.arm.streams.realtime import recorder
from hil.cell.arm.streams.robot_state import first_state, state

BUILT: Final = "20-06-2022, 10:00:00"
"""The build date of every emulated version, as the dashboard gives it."""

TENTH: Final = 100_000_000
"""Robot states go out at 10 Hz, whatever the control rate."""


class Stream(Protocol):
    """One client's stream."""

    greeting: bytes

    def publish(self, step: int) -> bytes: ...
    def close(self) -> None: ...


class SecondaryStream:
    """The version, then robot states at 10 Hz."""

    def __init__(self, box: ControlBox) -> None:
        self.greeting = encode_message(Version(box.version, BUILT), 0)
        self._box = box
        self._first = True

    def publish(self, step: int) -> bytes:
        """The state, in the first control step after each tenth of a second."""
        period = self._box.period
        if self._first:
            self._first = False
            return first_state(self._box)
        return state(self._box) if step * period % TENTH < period else b""

    def close(self) -> None:
        """Nothing is held for the client."""


class PrimaryStream:
    """What the secondary port sends, and messages in the step in which they arise."""

    def __init__(self, box: ControlBox) -> None:
        self._states = SecondaryStream(box)
        self.greeting = self._states.greeting
        self._box = box
        self._safety = SafetyMode.NORMAL
        self._messages = box.announcer.subscribe()

    def publish(self, step: int) -> bytes:
        """Messages first; a change of the safety mode brings its state with it.

        UR's client judges by the state whether an unlock is over, so a state of up to 0.1 s ago
        must not contradict a stop that it has been told of.
        """
        changed = self._box.modes.safety is not self._safety
        if changed:
            self._safety = self._box.modes.safety
            self._messages.appendleft((self._box.t, SafetyModeChange(self._safety)))
        states = self._states.publish(step)
        return self._news() + (states or (state(self._box) if changed else b""))

    def close(self) -> None:
        self._box.announcer.unsubscribe(self._messages)

    def _news(self) -> bytes:
        messages = self._messages
        if not messages:
            return b""
        news = b"".join(encode_message(message, t) for t, message in messages)
        messages.clear()
        return news


class RealtimeStream:
    """A record every control period."""

    greeting = b""

    def __init__(self, box: ControlBox) -> None:
        self._record = recorder(box)

    def publish(self, step: int) -> bytes:
        return self._record()

    def close(self) -> None:
        """Nothing is held for the client."""
