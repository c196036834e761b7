"""The study file: what is searched, over which contacts, for what, and within which limits."""

from pathlib import Path
from typing import Literal, TypeVar

import yaml
from pydantic import Field, ValidationError

from hil.experiments.force_tracking.figures import Figures
from hil.tuning.errors import TuningError
from hil.tuning.ranges import Part, Range

Figure = Literal["overshoot", "settling", "rms_static", "rms_tracking", "peak"]
assert set(Figure.__args__) | {"unstable"} == set(Figures._fields)  # type: ignore[attr-defined]


Kind = TypeVar("Kind", bound=Part)


class StudyFile(Part):
    """stiffnesses: N/mm. latencies: ms. force: N. approach, push: mm/s.

    objective: weight of the logarithm of each figure (SI, as in the table), averaged over the grid;
    floor: a figure below it counts as it. constraints: largest allowed value of a figure, and
    `unstable` runs, over the grid. parameters: by their dotted name in the law's settings.
    """

    law: str
    rig: str = "surface_ur5"
    stiffnesses: tuple[float, ...] = (1.0, 3.0, 10.0, 30.0, 100.0)
    latencies: tuple[float, ...] = (6.0,)
    seeds: tuple[int, ...] = (1000,)
    force: float = Field(default=10.0, gt=0)
    approach: float = Field(default=4.0, gt=0)
    push: float = Field(default=16.0, gt=0)
    objective: dict[Figure, float]
    floor: dict[Figure, float] = Field(default_factory=dict)
    constraints: dict[Figure | Literal["unstable"], float] = Field(default={"unstable": 0.0})
    fixed: dict[str, float | bool] = Field(default_factory=dict)
    parameters: dict[str, Range] = Field(min_length=1)


def load(path: Path) -> StudyFile:
    """The study of a force law in a YAML file; TuningError says in one line what is wrong."""
    return read(path, StudyFile)


def read(path: Path, kind: type[Kind]) -> Kind:
    """A study of this kind in a YAML file; TuningError says in one line what is wrong."""
    try:
        content = yaml.safe_load(path.read_text(encoding="utf-8"))
        return kind.model_validate(content)
    except OSError as error:
        raise TuningError(f"{path}: cannot be read: {error.strerror}") from None
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise TuningError(f"{path}: not YAML: {' '.join(str(error).split())}") from None
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(str(step) for step in first["loc"])
        raise TuningError(f"{path}: {where}: {first['msg']}") from None


def nested(values: dict[str, float | bool]) -> dict[str, object]:
    """Dotted names as the groups they stand for: {"a.b": 1} is {"a": {"b": 1}}."""
    tree: dict[str, object] = {}
    for name, value in values.items():
        *groups, leaf = name.split(".")
        branch = tree
        for group in groups:
            found = branch.setdefault(group, {})
            if not isinstance(found, dict):
                raise TuningError(f"parameter {name}: {group} is a number and a group")
            branch = found
        branch[leaf] = value
    return tree
