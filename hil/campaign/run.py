"""One run of a campaign: what identifies it, what its function returns, what became of it."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from enum import StrEnum
from hashlib import sha256
from typing import NamedTuple, TypeAlias

Json: TypeAlias = "bool | int | float | str | Sequence[Json] | Mapping[str, Json] | None"


class Verdict(StrEnum):
    """How a run ended. The last three are the runner's: the function itself never came back."""

    PASSED = "passed"
    FAILED = "failed"
    BLOCKED = "blocked"  # the rig could not show what was asked, the product is not to blame
    VACUOUS = "vacuous"  # what the run was about never happened
    ERROR = "error"
    CRASH = "crash"
    HANG = "hang"

    @property
    def broken(self) -> bool:
        """Whether the run has no figures, as its function never came back."""
        return self in {Verdict.ERROR, Verdict.CRASH, Verdict.HANG}


class Key(NamedTuple):
    """What makes two runs the same run. rig: SHA-256 of its text. variant: canonical JSON."""

    function: str
    rig: str
    variant: str
    seed: int

    @property
    def name(self) -> str:
        """Twelve hexadecimal digits, to call the run by."""
        return sha256("\0".join(map(str, self)).encode()).hexdigest()[:12]


@dataclass(frozen=True, slots=True)
class Run:
    """One call of `function`, an import path `module:function`.

    rig: the rig file's text. variant: the choices that differ between runs of the campaign, JSON.
    """

    function: str
    rig: str
    seed: int
    variant: Mapping[str, Json] = field(default_factory=dict)

    @property
    def key(self) -> Key:
        digest = sha256(self.rig.encode()).hexdigest()
        return Key(self.function, digest, canonical(self.variant), self.seed)


@dataclass(frozen=True, slots=True)
class Report:
    """What a campaign's function returns.

    figures: what the run found, JSON; the same for the same run wherever it is computed. timing:
    wall-clock figures, kept beside them and never part of a ledger's digest.
    """

    figures: Mapping[str, Json]
    verdict: Verdict = Verdict.PASSED
    reason: str = ""
    timing: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of a run. wall: s. trace: where an error, a crash or a hang happened, or ""."""

    verdict: Verdict
    reason: str = ""
    figures: Mapping[str, Json] = field(default_factory=dict)
    timing: Mapping[str, float] = field(default_factory=dict)
    trace: str = ""
    wall: float = 0.0


def canonical(value: Json) -> str:
    """JSON in one spelling: sorted keys, no spaces; ValueError for NaN and infinities."""
    return json.dumps(value, sort_keys=True, separators=(",", ":"), allow_nan=False)


def encode(value: Run | Outcome) -> bytes:
    """JSON text for a pipe."""
    return canonical(asdict(value)).encode()


def decode_run(content: bytes) -> Run:
    return Run(**json.loads(content))


def decode_outcome(content: bytes) -> Outcome:
    fields = json.loads(content)
    return Outcome(**{**fields, "verdict": Verdict(fields["verdict"])})
