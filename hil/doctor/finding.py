"""What a check says: how it stands, what was found, what to do about it."""

from dataclasses import dataclass
from enum import StrEnum


class Verdict(StrEnum):
    """FAIL: what is required is not there. WARN: a part will not work, or worse than it could."""

    OK = "ok"
    WARN = "warn"
    FAIL = "fail"


@dataclass(frozen=True, slots=True)
class Finding:
    """name: what was looked at. advice: what to do, "" where nothing is."""

    name: str
    verdict: Verdict
    found: str
    advice: str = ""
