"""Where a CAN bus is, as both sides name it to python-can."""

from typing import NamedTuple


class BusAddress(NamedTuple):
    """interface: python-can's name of a back end. channel: as that back end writes it; for
    udp_multicast `group:port`, because its sockets hear every group of their port.
    """

    interface: str
    channel: str

    def options(self) -> dict[str, str | int]:
        """Keyword arguments of `can.Bus`; ValueError for a channel that cannot be."""
        if self.interface != "udp_multicast":
            return {"interface": self.interface, "channel": self.channel}
        group, port, hop_limit = self.group
        return {"interface": self.interface, "channel": group, "port": port, "hop_limit": hop_limit}

    @property
    def group(self) -> tuple[str, int, int]:
        """Group, port and hop limit of a udp_multicast channel; ValueError when it is none.

        Hop limit 0 keeps every frame on this host: two testbeds on one LAN must not mix.
        """
        group, colon, port = self.channel.partition(":")
        if not colon or not port.isdigit():
            raise ValueError(f"udp_multicast channel '{self.channel}' is not 'group:port'")
        return group, int(port), 0
