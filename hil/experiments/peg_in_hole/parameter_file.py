"""Learners' parameters in a file: YAML, each learner's name over parameters by dotted name."""

from pathlib import Path

import yaml
from pydantic import TypeAdapter, ValidationError

from learner.errors import LearnerParameterError
from learner.parameters import Value

Sets = dict[str, dict[str, Value]]


def load(path: Path) -> Sets:
    """The sets in the file; LearnerParameterError says in one line what is wrong."""
    try:
        return TypeAdapter(Sets).validate_python(yaml.safe_load(path.read_text(encoding="utf-8")))
    except OSError as error:
        raise LearnerParameterError(f"{path}: cannot be read: {error.strerror}") from None
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise LearnerParameterError(f"{path}: not YAML: {' '.join(str(error).split())}") from None
    except ValidationError as error:
        where = ".".join(str(step) for step in error.errors()[0]["loc"])
        raise LearnerParameterError(
            f"{path}: {where or 'all of it'}: {error.errors()[0]['msg']}; write learner: "
            "{parameter: value}"
        ) from None


def write(path: Path, learner: str, values: dict[str, Value], comment: str) -> None:
    """One learner's set, and the command that found it."""
    rounded = {n: float(f"{v:.4g}") if isinstance(v, float) else v for n, v in values.items()}
    body = yaml.safe_dump({learner: rounded}, sort_keys=True)
    path.write_text(f"# {comment}\n{body}", encoding="utf-8")
