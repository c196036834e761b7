"""A run worth keeping, as a file: rig, seed, policy and faults; `hil replay` and pytest run it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

import yaml

from hil.cell.errors import FaultError
from hil.cell.faults.parse import schedule
from hil.cell.faults.schedule import Schedule
from hil.falsify.errors import FalsifyError
from hil.monitors.errors import MonitorError
from hil.monitors.monitor import Monitor
from hil.trial.signals import SCALES
from hil.trial.trial import Trial
from hil.trial.verdict import Verdict

SUFFIX: Final = ".regression.yaml"
"""By which pytest knows such a file."""
KEYS: Final = ("rig", "seed", "policy", "faults", "formula", "found", "any_value")


@dataclass(frozen=True, slots=True)
class Regression:
    """rig: a shipped name, or a path as seen from the file. found: what it violated, in words.

    any_value: parameters that did not matter, as `C1.share`. formula: what has to hold in every
    period besides the always-on monitors, if anything.
    """

    rig: str
    seed: int
    policy: str
    schedule: Schedule
    found: str = ""
    any_value: tuple[str, ...] = field(default=())
    formula: str = ""

    def violated(self, trial: Trial) -> str:
        """What a run under it did wrong, in words; "" for nothing."""
        if trial.verdict is not Verdict.PASSED:
            return f"{trial.verdict.value}: {trial.reason}"
        robustness = trial.trace.robustness(self.formula) if self.formula else 0.0
        return f"{self.formula}: robustness {robustness:+.3f}" if robustness < 0.0 else ""

    def as_yaml(self) -> str:
        content: dict[str, object] = {"rig": self.rig, "seed": self.seed, "policy": self.policy}
        content |= self.schedule.written()
        if self.formula:
            content["formula"] = self.formula
        if self.found:
            content["found"] = self.found
        if self.any_value:
            content["any_value"] = list(self.any_value)
        return yaml.safe_dump(content, sort_keys=False, width=100)


def load(path: Path) -> Regression:
    """Read one; FalsifyError or FaultError say in one line what is wrong."""
    try:
        content = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "is not UTF-8 text"
        raise FalsifyError(f"{path}: cannot be read: {reason}") from None
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        raise FalsifyError(f"{path}: not YAML: {' '.join(str(error).split())}") from None
    if not isinstance(content, Mapping):
        raise FalsifyError(f"{path}: a mapping of {', '.join(KEYS)} is wanted")
    return _read(path, content)


def _read(path: Path, content: Mapping[object, object]) -> Regression:
    for key in content:
        if key not in KEYS:
            raise FalsifyError(f"{path}: no such key {key!r}; there are: {', '.join(KEYS)}")
    rig, seed, policy = content.get("rig"), content.get("seed"), content.get("policy", "pose")
    if not isinstance(rig, str) or not isinstance(policy, str):
        raise FalsifyError(f"{path}: rig and policy are names, found {rig!r} and {policy!r}")
    if type(seed) is not int or seed < 0:
        raise FalsifyError(f"{path}: seed: {seed!r} is not a whole number from 0")
    try:
        faults = schedule({"faults": content.get("faults")})
    except FaultError as error:
        raise FaultError(f"{path}: {error}") from None
    any_value = content.get("any_value", ())
    words = tuple(map(str, any_value)) if isinstance(any_value, Sequence) else ()
    beside = path.parent / rig
    where = str(beside) if beside.is_file() else rig
    formula = _formula(path, content.get("formula", ""))
    found = str(content.get("found", ""))
    return Regression(where, seed, policy, faults, found, words, formula)


def _formula(path: Path, text: object) -> str:
    try:
        if text:
            Monitor(str(text), SCALES)
    except MonitorError as error:
        raise FalsifyError(f"{path}: formula: {error}") from None
    return str(text)
