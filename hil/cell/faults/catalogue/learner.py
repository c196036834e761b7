"""L1 to L5: policy and learner."""

from typing import Final

from hil.cell.faults.row import Parameter, Phase, Place, Row, word

_CHOOSING: Final = (Phase.SEARCH,)

LEARNER: Final = (
    Row(
        "L1", "learner.stale", "Stale table, lost update", Place.POLICY,
        (Parameter("age", 10, "", 1, 10_000, whole=True),),
        "act within the step limits only; staleness in the log",
        "size of the action bounded whatever the table says",
        phases=_CHOOSING,
    ),
    Row(
        "L2", "learner.corrupt", "Corrupt, NaN or adversarial action", Place.POLICY,
        (word("value", "nan", "out_of_range", "none", "adversarial"),),
        "the action filter rejects it; without an action hold",
        "no unsafe command for any sequence of actions",
        phases=_CHOOSING,
    ),
    Row(
        "L3", "learner.agent", "One of n agents crashes", Place.AGENTS,
        (Parameter("agent", 0, "", 0, 1000, whole=True),),
        "the others go on; the pool stays consistent",
        "invariants of the pool; progress",
        phases=_CHOOSING,
    ),
    Row(
        "L4", "learner.server", "Parameter server restarts, or evaluates with the wrong model",
        Place.AGENTS,
        (word("what", "restart", "wrong_model"),),
        "reconnect, check the version, do not learn from a model that does not match",
        "version in the log; episode flagged",
        phases=_CHOOSING,
    ),
    Row(
        "L5", "learner.slow", "Learner slower than control", Place.POLICY,
        (Parameter("delay", 60e-3, "s", 0.0, 10.0),),
        "control never waits; hold the target",
        "loop statistics; count of holds",
        phases=_CHOOSING,
    ),
)  # fmt: skip
