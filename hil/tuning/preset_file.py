"""A tuned set as a preset, with the command that made it."""

from pathlib import Path

import yaml
from optuna.trial import FrozenTrial

from hil.tuning.study_file import StudyFile, nested


def write(path: Path, study: StudyFile, trial: FrozenTrial, command: str) -> None:
    """Put one law's parameters into the file, keeping the other laws that it holds."""
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    content = yaml.safe_load(text) or {}
    comments = [line for line in text.splitlines() if line.startswith("#")]
    mark = f"# {study.law}:"
    kept = [line for line in comments if not line.startswith(mark)]
    content[study.law] = nested({**study.fixed, **_rounded(trial.params)})
    kept.append(f"{mark} {command} (trial {trial.number}, cost {trial.value:.3f}, {_kept(trial)})")
    body = yaml.safe_dump(content, sort_keys=True)
    path.write_text("\n".join(kept) + "\n" + body, encoding="utf-8")


def _kept(trial: FrozenTrial) -> str:
    broken = [name for name, violation in trial.constraints.items() if violation > 0.0]
    return f"broken: {', '.join(broken)}" if broken else "all constraints kept"


def _rounded(values: dict[str, float]) -> dict[str, float | bool]:
    return {name: float(f"{value:.4g}") for name, value in values.items()}
