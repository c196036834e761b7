"""What can be wrong with a formula or its signals."""


class MonitorError(ValueError):
    """A formula that cannot be read, or that names a signal which is not there."""
