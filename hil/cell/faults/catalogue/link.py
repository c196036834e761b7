"""T1 to T12: the RTDE link between host and robot."""

from typing import Final

from hil.cell.faults.row import Parameter, Place, Row, word

_WAY: Final = word("direction", "both", "from_cell", "to_cell")

LINK: Final = (
    Row(
        "T1", "rtde.latency", "Added latency", Place.RTDE,
        (
            Parameter("mean", 6e-3, "s", 0.0, 1.0),
            Parameter("jitter", 2e-3, "s", 0.0, 1.0),
            word("law", "uniform", "normal", "constant"),
            _WAY,
        ),
        "within the bound stay stable below f_b; over it slow down or stop",
        "command age at the robot; force bound; no limit cycle",
    ),
    Row(
        "T2", "rtde.spike", "Latency spike", Place.RTDE,
        (Parameter("size", 60e-3, "s", 0.0, 10.0), _WAY),
        "treat as stale; no catch-up burst of old commands",
        "at most one command applied a cycle; no jump above the step limit",
        lasting=False,
    ),
    Row(
        "T3", "rtde.stall", "Stall: the socket stays open, nothing comes", Place.RTDE,
        (_WAY._replace(default="from_cell"),),
        "declare stale after W cycles, stop, never extrapolate contact motion",
        "stale event within W; standstill within N cycles after it",
    ),
    Row(
        "T4", "rtde.half_open", "Half-open link: one direction is dead", Place.RTDE,
        (word("direction", "to_cell", "from_cell"),),
        "the robot-side watchdog stops the arm; the host notices",
        "robot's program ended; host reports the link lost",
    ),
    Row(
        "T5", "rtde.reset", "Connection reset", Place.RTDE,
        (word("how", "rst", "fin"),),
        "stop; reconnect with the whole handshake; resume only on permission",
        "set-up packages seen again; first command within one step of the actual pose",
        lasting=False,
    ),
    Row(
        "T6", "rtde.refused", "Connection refused at the start", Place.RTDE,
        (Parameter("count", 2, "", 1, 1000, whole=True),),
        "bounded retries with back-off, a clear error, no motion",
        "attempts in the log; verdict blocked",
        start=True,
    ),
    Row(
        "T7", "rtde.fragments", "Fragmented and coalesced segments", Place.RTDE,
        (Parameter("size", 7, "B", 1, 4096, whole=True), _WAY),
        "the parser is not affected",
        "decoded packages equal those sent",
    ),
    Row(
        "T8", "rtde.corrupt", "Corrupted bytes or wrong length", Place.RTDE,
        (
            word("field", "length", "type", "payload"),
            Parameter("share", 1.0, "", 0.0, 1.0),
            Parameter("bits", 1, "", 1, 64, whole=True),
            _WAY._replace(default="from_cell"),
        ),
        "drop connection or package; never act on it",
        "rejected counter; no command or sample comes of it",
    ),
    Row(
        "T9", "rtde.replay", "Duplicated, re-ordered or replayed package", Place.RTDE,
        (
            word("how", "duplicate", "replay", "reorder"),
            Parameter("depth", 3, "", 1, 100, whole=True),
            _WAY._replace(default="from_cell"),
        ),
        "discard by time stamp; no time going backwards in the controller",
        "the controller's time step is never negative",
    ),
    Row(
        "T10", "rtde.recipe", "Recipe or protocol refused", Place.RTDE,
        (word("what", "output", "input", "version"),),
        "fail at the start with the field's name",
        "verdict blocked, with a message",
        start=True,
    ),
    Row(
        "T11", "rtde.slow_client", "Client too slow: its buffer is full", Place.RTDE,
        (
            Parameter("rate", 2000.0, "B/s", 1.0, 1e9),
            Parameter("buffer", 16384, "B", 1, 1e9, whole=True),
        ),
        "the robot cuts the client off; the host recovers or stops",
        "cut-off in the robot's log; standstill within N",
    ),
    Row(
        "T12", "rtde.second_writer", "Another client takes the RTDE inputs", Place.RTDE,
        (),
        "notice the loss of authority, stop",
        "'in use by another client' reaches the user",
    ),
)  # fmt: skip
