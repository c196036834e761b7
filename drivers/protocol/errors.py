"""The error of the shared codecs."""


class WireError(Exception):
    """The peer's bytes break their protocol: what was found, what was allowed."""
