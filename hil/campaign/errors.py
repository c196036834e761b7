"""What goes wrong with a campaign itself, not with one of its runs."""


class CampaignError(Exception):
    """A ledger, a function or a scheduler that cannot be used; says what to do instead."""
