"""The tuning room's error tree."""


class TuningError(Exception):
    """A study file or a journal that cannot be used: what was found, what is allowed."""
