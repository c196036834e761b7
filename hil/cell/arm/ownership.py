"""Which client owns which RTDE input: one writer each, until it leaves."""

from collections.abc import Iterable
from typing import Final

FIELDBUS: Final = -1
"""Stands for EtherNet/IP or PROFINET, which hold registers 0..23 when they are switched on."""


class Ownership:
    """Owners by input name; a client is any number that its connection alone uses."""

    __slots__ = ("_owners",)

    def __init__(self) -> None:
        self._owners: dict[str, int] = {}

    def conflicts(self, names: Iterable[str], client: int) -> frozenset[str]:
        """The names that another client owns."""
        owners = self._owners
        return frozenset(name for name in names if owners.get(name, client) != client)

    def claim(self, names: Iterable[str], client: int) -> None:
        """Make `client` the owner; ValueError names inputs that another one owns."""
        names = tuple(names)
        if taken := self.conflicts(names, client):
            raise ValueError(f"owned by another client: {', '.join(sorted(taken))}")
        self._owners.update(dict.fromkeys(names, client))

    def seize(self, names: Iterable[str], client: int) -> None:
        """Make `client` the owner, whoever was: what a fieldbus does that is switched on."""
        self._owners.update(dict.fromkeys(names, client))

    def release(self, client: int) -> None:
        self._owners = {n: owner for n, owner in self._owners.items() if owner != client}
