"""What can be wrong with a search."""


class FalsifyError(ValueError):
    """A search that cannot be begun as asked."""
