"""The CAN bus from node to host, with its faults; error frames go straight to the gateway."""

from collections.abc import Iterable
from typing import Final, NamedTuple

import can
import numpy as np

from drivers.protocol.can_error import ErrorClass
from drivers.protocol.frame import CanFrame
from drivers.protocol.nrs_can import Identifiers
from hil.cell.faults.injector import Running
from hil.cell.injection import frames
from hil.cell.injection.frames import NS, Timed
from hil.cell.injection.injection import Injection
from hil.cell.link import Link
from hil.cell.rig import LatencyLaw
from hil.cell.sensor.gateway import Gateway

_CONTROLLER: Final = {"passive": 0x10, "warning": 0x04}
"""data[1] of an error frame: receiver passive, receiver warning (linux/can/error.h)."""


class Shout(NamedTuple):
    """An error frame: its class, and data[1]."""

    kind: int
    status: int


class InjectedWire(Link[CanFrame]):
    """Frames of the node on their way; shouts: error frames that the gateway sends next."""

    def __init__(
        self, law: LatencyLaw, rng: np.random.Generator, injection: Injection, ids: Identifiers
    ) -> None:
        super().__init__(law, rng)
        self._injection, self._ids = injection, ids
        self.shouts: list[Shout] = []
        self._free = 0
        self._frozen: dict[int, int] = {}
        self._errors: dict[int, int] = {}
        injection.add(self)

    def before(self, t: int) -> None:
        """Nothing: a bus acts on frames."""

    def after(self, t: int) -> None:
        """Errors come whether or not there are frames."""
        for one in self._injection.of("C6"):
            state = one.fault.word("state")
            due = round(one.fault.number("rate") * (t - one.since) / NS)
            count = due - self._errors.get(one.index, 0)
            self._errors[one.index] = due
            self.shouts += [Shout(ErrorClass.CONTROLLER, _CONTROLLER[state])] * count
            one.felt(t, f"error {state}")
        for one in self._injection.of("C7"):
            self._off(one, t)

    def extend(self, messages: Iterable[tuple[int, CanFrame]]) -> None:
        batch = list(messages)
        for kind, act in (
            ("C4", self._bend), ("C9", self._halve), ("C1", self._lose), ("C3", self._replay),
            ("C5", self._spoil), ("C8", self._crowd), ("C2", self._delay), ("C7", self._silence),
        ):  # fmt: skip
            for one in self._injection.of(kind):
                changed = act(one, batch) if batch else batch
                if changed != batch:
                    one.felt(batch[0][0], f"{len(batch)} frames met it")
                batch = changed
        super().extend(batch)

    def _lose(self, one: Running, batch: list[Timed]) -> list[Timed]:
        share, burst = one.fault.number("share"), one.fault.number("burst")
        return frames.lost(batch, share, burst, one.draws(batch[0][0]))

    def _delay(self, one: Running, batch: list[Timed]) -> list[Timed]:
        mean, jitter = one.fault.number("mean"), one.fault.number("jitter")
        drawn = mean + jitter * one.draws(batch[0][0]).uniform(-1.0, 1.0, len(batch))
        late = np.rint(np.maximum(drawn, 0.0) * NS).astype(np.int64).tolist()
        return [(t + extra, frame) for (t, frame), extra in zip(batch, late, strict=True)]

    def _replay(self, one: Running, batch: list[Timed]) -> list[Timed]:
        if one.fault.word("how") == "duplicate":
            return frames.duplicated(batch)
        return frames.reordered(batch, int(one.fault.number("depth")))

    def _bend(self, one: Running, batch: list[Timed]) -> list[Timed]:
        rng, fault = one.draws(batch[0][0]), one.fault
        how, bits, share = fault.word("how"), int(fault.number("bits")), fault.number("share")
        found = []
        for t, frame in batch:
            if frames.is_sample(frame, self._ids) and rng.random() < share:
                frozen = self._frozen.setdefault(one.index, frames.counter_of(frame))
                found.append((t, frames.bent(frame, how, bits, frozen, rng)))
            else:
                found.append((t, frame))
        return found

    def _spoil(self, one: Running, batch: list[Timed]) -> list[Timed]:
        return frames.foreign(batch, one.fault.word("what"), self._ids)

    def _halve(self, one: Running, batch: list[Timed]) -> list[Timed]:
        missing = self._ids.torque if one.fault.word("missing") == "torque" else self._ids.force
        return frames.half(batch, missing, one.fault.number("share"), one.draws(batch[0][0]))

    def _crowd(self, one: Running, batch: list[Timed]) -> list[Timed]:
        load = one.fault.number("load")
        through, self._free = frames.crowded(batch, load, self._free, one.until)
        flood = frames.babble(batch[0][0], batch[-1][0] + 1, load)
        return sorted([*through, *flood], key=lambda timed: timed[0])

    def _off(self, one: Running, t: int) -> None:
        down = round(one.fault.number("down") * NS)
        if one.index not in self._errors:
            self._errors[one.index] = 1
            self.shouts.append(Shout(ErrorClass.BUS_OFF, 0))
            one.felt(t, "bus-off")
        elif t >= one.since + down:
            self.shouts.append(Shout(ErrorClass.RESTARTED, 0))
            one.done(t)

    def _silence(self, one: Running, batch: list[Timed]) -> list[Timed]:
        return []


class InjectedGateway(Gateway):
    """Sends what the wire shouts before the frames of a period."""

    def __init__(self, gateway: Gateway, wire: InjectedWire) -> None:
        super().__init__(gateway._bus, gateway.address, gateway._say)
        self._wire = wire

    def send(self, frames: list[CanFrame]) -> None:
        shouts, self._wire.shouts = self._wire.shouts, []
        for kind, status in shouts:
            self._bus.send(
                can.Message(
                    arbitration_id=kind, is_error_frame=True, is_extended_id=False,
                    data=bytes((0, status, 0, 0, 0, 0, 0, 0)),
                )
            )  # fmt: skip
        super().send(frames)
