"""C1 to C9: the CAN bus between sensor node and host."""

from typing import Final

from hil.cell.faults.row import Parameter, Place, Row, word

BUS: Final = (
    Row(
        "C1", "can.drop", "Frames lost", Place.BUS,
        (
            Parameter("share", 1.0, "", 0.0, 1.0),
            Parameter("burst", 1.0, "", 1.0, 1000.0),
        ),
        "hold the last value for at most W frames, then stop",
        "sensor age; stop latency",
    ),
    Row(
        "C2", "can.delay", "Frames late", Place.BUS,
        (Parameter("mean", 20e-3, "s", 0.0, 1.0), Parameter("jitter", 0.0, "s", 0.0, 1.0)),
        "sample time counts, not arrival",
        "wrench age at most X",
    ),
    Row(
        "C3", "can.replay", "Frames duplicated or out of order", Place.BUS,
        (word("how", "duplicate", "reorder"), Parameter("depth", 2, "", 1, 100, whole=True)),
        "sequence check",
        "duplicates ignored",
    ),
    Row(
        "C4", "can.payload", "Payload bent above the CAN layer", Place.BUS,
        (
            word("how", "bits", "zeros", "counter"),
            Parameter("bits", 1, "", 1, 64, whole=True),
            Parameter("share", 1.0, "", 0.0, 1.0),
        ),
        "plausibility and counter check",
        "implausible counter; no force step above the slew limit accepted",
    ),
    Row(
        "C5", "can.foreign", "Wrong length, unknown identifiers", Place.BUS,
        (word("what", "length", "unknown", "both"),),
        "ignored, no exception",
        "process alive; error counter",
    ),
    Row(
        "C6", "can.errors", "Error frames, error passive", Place.BUS,
        (
            Parameter("rate", 1000.0, "Hz", 1.0, 8000.0),
            word("state", "passive", "warning"),
        ),
        "warn, then stop at error passive",
        "event of the bus state",
    ),
    Row(
        "C7", "can.bus_off", "Bus-off and recovery", Place.BUS,
        (Parameter("down", 0.1, "s", 0.0, 60.0),),
        "stop at bus-off; resume only after k good frames",
        "bus-off count 1; standstill within N",
        lasting=False,
    ),
    Row(
        "C8", "can.load", "Babbling idiot: the bus is full", Place.BUS,
        (Parameter("load", 1.0, "", 0.0, 1.0),),
        "wrench age within its bound, or stop",
        "histogram of ages",
    ),
    Row(
        "C9", "can.half", "Half a wrench: one frame of the pair is missing", Place.BUS,
        (word("missing", "torque", "force"), Parameter("share", 1.0, "", 0.0, 1.0)),
        "never combine frames of different cycles",
        "pairing counter",
    ),
)  # fmt: skip
