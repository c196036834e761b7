"""All fuzz targets by name."""

from fuzz import files, scripts, sessions, texts, wires
from fuzz.target import Target

TARGETS: dict[str, Target] = {
    **wires.TARGETS,
    **texts.TARGETS,
    **files.TARGETS,
    **sessions.TARGETS,
    **scripts.TARGETS,
}
