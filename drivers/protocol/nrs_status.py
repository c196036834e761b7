"""Codec of what the sensor node says about itself: STATUS, HEARTBEAT and EMCY."""

import struct
from enum import IntEnum, IntFlag
from typing import Final, NamedTuple

from drivers.protocol.frame import CanFrame
from drivers.protocol.nrs_can import Identifiers, ProtocolError, expect_length

_STATUS: Final = struct.Struct("<HBBI")
_EMERGENCY: Final = struct.Struct("<HBHBxB")


class StatusBit(IntFlag):
    """Bits of STATUS; the low six name the overloaded axis."""

    OVERLOAD_FX = 1 << 0
    OVERLOAD_FY = 1 << 1
    OVERLOAD_FZ = 1 << 2
    OVERLOAD_TX = 1 << 3
    OVERLOAD_TY = 1 << 4
    OVERLOAD_TZ = 1 << 5
    ADC_SATURATED = 1 << 6
    ANY_FAULT = 1 << 7
    TRANSMIT_ON = 1 << 8
    TARED = 1 << 9
    FILTER_ON = 1 << 10
    WARMING_UP = 1 << 11
    TEMPERATURE_OUT_OF_RANGE = 1 << 12
    SUPPLY_OUT_OF_RANGE = 1 << 13
    GAUGE_FAULT = 1 << 14
    CALIBRATION_INVALID = 1 << 15


class NodeState(IntEnum):
    """State in HEARTBEAT; BOOT is sent once, when the node starts."""

    BOOT = 0
    STOPPED = 4
    OPERATIONAL = 5
    PRE_OPERATIONAL = 127


class EmergencyCode(IntEnum):
    """CANopen error codes (CiA 301) and, from 0xFF01, this device's own."""

    ERROR_RESET = 0x0000
    GENERIC = 0x1000
    SUPPLY_VOLTAGE = 0x3100
    TEMPERATURE = 0x4200
    HARDWARE_GAUGE = 0x5000
    CAN_OVERRUN = 0x8110
    CAN_ERROR_PASSIVE = 0x8120
    RECOVERED_BUS_OFF = 0x8140
    FORCE_OVERLOAD = 0xFF01
    TORQUE_OVERLOAD = 0xFF02


class Status(NamedTuple):
    """temperature: degrees Celsius. sample_count: samples sent since boot."""

    bits: StatusBit
    temperature: float
    tx_dropped: int
    sample_count: int


class Emergency(NamedTuple):
    """One error event; axis counts from 0, 255 when no axis is meant."""

    code: EmergencyCode
    register: int
    vendor: int
    axis: int
    counter: int


def encode_status(ids: Identifiers, status: Status) -> CanFrame:
    half_degrees = min(255, max(0, round((status.temperature + 40.0) * 2)))
    octets = _STATUS.pack(
        status.bits, half_degrees, status.tx_dropped & 0xFF, status.sample_count & 0xFFFFFFFF
    )
    return CanFrame(ids.status, octets)


def decode_status(octets: bytes) -> Status:
    """STATUS payload; raises ProtocolError."""
    expect_length(octets, 8, "STATUS")
    bits, half_degrees, dropped, count = _STATUS.unpack(octets)
    return Status(StatusBit(bits), half_degrees / 2 - 40.0, dropped, count)


def encode_heartbeat(ids: Identifiers, state: NodeState) -> CanFrame:
    return CanFrame(ids.heartbeat, bytes((state,)))


def decode_heartbeat(octets: bytes) -> NodeState:
    """HEARTBEAT payload; raises ProtocolError."""
    expect_length(octets, 1, "HEARTBEAT")
    try:
        return NodeState(octets[0] & 0x7F)
    except ValueError:
        raise ProtocolError(f"HEARTBEAT: unknown node state {octets[0]}") from None


def encode_emergency(ids: Identifiers, event: Emergency) -> CanFrame:
    octets = _EMERGENCY.pack(
        event.code, event.register, event.vendor, event.axis, event.counter & 0xFF
    )
    return CanFrame(ids.emergency, octets)


def decode_emergency(octets: bytes) -> Emergency:
    """EMCY payload; raises ProtocolError."""
    expect_length(octets, 8, "EMCY")
    code, register, vendor, axis, counter = _EMERGENCY.unpack(octets)
    try:
        return Emergency(EmergencyCode(code), register, vendor, axis, counter)
    except ValueError:
        raise ProtocolError(f"EMCY: unknown error code {code:#06x}") from None
