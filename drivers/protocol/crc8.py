"""CRC-8 SAE J1850: polynomial 0x1D, initial value 0xFF, final XOR 0xFF."""

POLYNOMIAL = 0x1D


def _remainder(byte: int) -> int:
    for _ in range(8):
        byte = (byte << 1 ^ POLYNOMIAL if byte & 0x80 else byte << 1) & 0xFF
    return byte


TABLE = bytes(_remainder(byte) for byte in range(256))


def crc8(octets: bytes) -> int:
    """Checksum of `octets`; 0x4B for b"123456789"."""
    remainder = 0xFF
    for octet in octets:
        remainder = TABLE[remainder ^ octet]
    return remainder ^ 0xFF
