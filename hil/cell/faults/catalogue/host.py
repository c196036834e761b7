"""H1 to H4: the computer that the controller runs on."""

from typing import Final

from hil.cell.faults.row import Parameter, Place, Row, word

HOST: Final = (
    Row(
        "H1", "host.pause", "Control loop paused: deadline missed", Place.HOST,
        (Parameter("pause", 50e-3, "s", 0.0, 10.0),),
        "the robot-side watchdog covers it; no burst afterwards",
        "count of misses; at most one command a cycle",
        lasting=False,
    ),
    Row(
        "H2", "host.clock", "Wall clock jumps or runs off", Place.HOST,
        (
            Parameter("jump", 3600.0, "s", -1e9, 1e9),
            Parameter("skew", 0.0, "ppm", -1e6, 1e6),
        ),
        "all control on monotonic time; the log marks the jump",
        "time step sane; no stop, no NaN",
    ),
    Row(
        "H3", "host.killed", "Controller's process killed, or an exception in a callback",
        Place.HOST,
        (word("how", "kill", "exception"),),
        "the robot stops by itself; a supervisor reports the crash",
        "robot stands without its host",
        lasting=False,
    ),
    Row(
        "H4", "host.disk", "Disk full, or a slow logger", Place.HOST, (),
        "control is not affected; the log marks the gap",
        "loop statistics unchanged; record of the gap",
    ),
)  # fmt: skip
