"""S1 to S6: the force/torque sensor."""

from typing import Final

from hil.cell.faults.row import Parameter, Phase, Place, Row, word

_AXIS: Final = word("axis", "fz", "fx", "fy", "tx", "ty", "tz")

SENSOR: Final = (
    Row(
        "S1", "sensor.bias", "Bias or drift", Place.SENSOR,
        (
            Parameter("force", 3.0, "N", -1000.0, 1000.0),
            Parameter("torque", 0.0, "N*m", -100.0, 100.0),
            Parameter("drift", 0.0, "N/s", -1000.0, 1000.0),
            _AXIS,
        ),
        "re-tare in free space only; alarm over a limit (a jump in contact looks like contact)",
        "tare in the free phase; residual",
    ),
    Row(
        "S2", "sensor.noise", "Noise or spikes", Place.SENSOR,
        (
            Parameter("force", 1.0, "N", 0.0, 1000.0),
            Parameter("torque", 0.01, "N*m", 0.0, 100.0),
            Parameter("spike", 0.0, "N", 0.0, 1000.0),
            Parameter("spike_rate", 0.0, "Hz", 0.0, 1000.0),
        ),
        "filter; one spike does not trip, two in a row do",
        "never over the bound for more than one cycle",
    ),
    Row(
        "S3", "sensor.stuck", "Stuck value, the counter runs on", Place.SENSOR, (),
        "see the flat line within W samples",
        "flat-line event",
    ),
    Row(
        "S4", "sensor.saturation", "Saturation, clipping", Place.SENSOR,
        (
            Parameter("force", 4.0, "N", 0.0, 1000.0),
            Parameter("torque", 0.1, "N*m", 0.0, 100.0),
        ),
        "treat as over the limit and stop",
        "standstill within N",
    ),
    Row(
        "S5", "sensor.axes", "Axes swapped, sign or scale wrong", Place.SENSOR,
        (word("what", "sign", "swap", "scale"), Parameter("scale", 0.1, "", -10.0, 10.0)),
        "the self test at the start refuses to run",
        "verdict blocked before contact",
        phases=(Phase.FREE,),
    ),
    Row(
        "S6", "sensor.status", "Status bits: overload, supply, watchdog", Place.SENSOR,
        (word("bit", "overload", "supply", "watchdog"), _AXIS),
        "stop; after a restart of the node the tare is gone and must be taken anew",
        "standstill within N",
    ),
)  # fmt: skip
