"""The numbers of search and memory."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Search:
    """Costs of trying a pose once a slot is known, against a step along x or y off its last place.

    turn: a step about z off it; turns find it least. way: a step of way there.
    """

    turn: float = 2.0
    way: float = 0.6

    def __post_init__(self) -> None:
        if not (self.turn >= 0.0 and self.way >= 0.0):
            raise ValueError(f"costs cannot be negative, found {self}")
