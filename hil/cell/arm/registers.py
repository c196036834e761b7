"""General-purpose registers: what a client writes and a program reads, and the other way round."""

from typing import Final

COUNT: Final = 48  # integer and double registers; 0..23 are the fieldbus range
BITS: Final = 128


class Bank:
    """One direction's registers; they keep their values across programs and connections."""

    __slots__ = ("booleans", "floats", "integers")

    def __init__(self) -> None:
        self.integers = [0] * COUNT
        self.floats = [0.0] * COUNT
        self.booleans = [False] * BITS

    def word(self, first: int) -> int:
        """Bits first .. first + 31 as one number, as input_bit_registers0_to_31 carries them."""
        bits = self.booleans
        return sum(1 << n for n in range(32) if bits[first + n])

    def set_word(self, first: int, value: int) -> None:
        self.booleans[first : first + 32] = [bool(value >> n & 1) for n in range(32)]


class Registers:
    """inputs: from RTDE clients. outputs: from the program."""

    __slots__ = ("inputs", "outputs")

    def __init__(self) -> None:
        self.inputs = Bank()
        self.outputs = Bank()
