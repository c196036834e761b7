"""What happens to the driver when the bus underneath it fails."""

from functools import partial

import can
import pytest

from drivers.errors import LinkError
from drivers.nrs.bus import open_bus
from drivers.nrs.link import Link
from drivers.nrs.receiver import Receiver
from drivers.protocol.bus_address import BusAddress
from drivers.protocol.frame import CanFrame

ADDRESS = BusAddress("virtual", "link-under-test")


class FailingBus(can.BusABC):
    """Gives some messages and then fails, as a link that goes down."""

    def __init__(self, messages):
        super().__init__(channel="failing")
        self._left = list(messages)

    def _recv_internal(self, timeout):
        if not self._left:
            raise can.CanOperationError("network is down")
        return self._left.pop(0), True

    def send(self, msg, timeout=None):
        raise can.CanOperationError("network is down")


@pytest.fixture
def peer():
    with can.Bus(**ADDRESS.options()) as bus:
        yield bus


def test_the_receiver_hands_over_every_message_in_order(peer):
    with can.Bus(**ADDRESS.options()) as bus:
        receiver = Receiver(bus)
        for number in range(100):
            peer.send(can.Message(arbitration_id=number, is_extended_id=False))
        got = []
        while len(got) < 100:
            got += receiver.take()
        receiver.close()
    assert [message.arbitration_id for message in got] == list(range(100))


def test_a_receiver_whose_bus_fails_says_so_after_what_it_had():
    with FailingBus([can.Message(arbitration_id=5)]) as bus:
        receiver = Receiver(bus)
        while receiver.alive:
            pass
        assert [message.arbitration_id for message in receiver.take()] == [5]
        with pytest.raises(LinkError, match="network is down"):
            receiver.take()
        receiver.close()


@pytest.mark.parametrize("background", [False, True])
def test_a_failing_bus_is_reopened_and_remembered(background):
    buses = [FailingBus([can.Message(arbitration_id=5)]), can.Bus(**ADDRESS.options())]
    link = Link(lambda: buses.pop(0), background)
    link.open()
    while not link.last_error:
        link.take()
    assert link.take() == []
    assert "network is down" in link.last_error
    assert link.alive
    link.close()


def test_a_bus_that_fails_again_is_an_error():
    buses = [FailingBus([]), FailingBus([])]
    link = Link(lambda: buses.pop(0), background=False)
    link.open()
    with pytest.raises(LinkError, match="cannot send"):
        link.send(CanFrame(0x201, b""))
    link.close()


def test_what_is_sent_arrives_as_a_standard_frame(peer):
    link = Link(partial(open_bus, ADDRESS, False), background=False)
    link.open()
    link.send(CanFrame(0x201, b"\x07\x01\x01"))
    message = peer.recv(0)
    assert (message.arbitration_id, message.is_extended_id, bytes(message.data)) == (
        0x201,
        False,
        b"\x07\x01\x01",
    )
    link.close()
    assert not link.alive
