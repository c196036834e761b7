"""Which code computes a campaign: figures of one version are never taken for another's."""

import subprocess
from hashlib import sha256
from pathlib import Path

import hil
from hil.recording.identity import versions

SOURCES = ("controller", "drivers", "fixtures", "hil", "learner")
SUFFIXES = frozenset({".dbc", ".lark", ".py", ".script"})


def identity() -> str:
    """Commit, or a package's version where there is no checkout, and what computes beside us."""
    found = versions()
    checkout = Path(str(hil.__file__)).parents[1]
    return ", ".join(
        [
            _commit(checkout) or f"hil-testbed {found['hil-testbed']}",
            *(f"{name} {version}" for name, version in found.items() if name != "hil-testbed"),
        ]
    )


def _commit(checkout: Path) -> str:
    """As `git describe` has it; uncommitted sources are told apart by a digest. "" without git."""
    if not (checkout / ".git").exists():
        return ""
    try:
        described = subprocess.run(
            ["git", "-C", str(checkout), "describe", "--always", "--dirty", "--abbrev=12"],
            capture_output=True,
            text=True,
            check=True,
        ).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""
    return f"{described}.{_digest(checkout)}" if described.endswith("-dirty") else described


def _digest(checkout: Path) -> str:
    hashed = sha256()
    for path in sorted(path for room in SOURCES for path in (checkout / room).rglob("*")):
        if path.suffix in SUFFIXES:
            hashed.update(f"{path.relative_to(checkout)}\0".encode() + path.read_bytes())
    return hashed.hexdigest()[:12]
