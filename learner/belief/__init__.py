"""A belief over where the slot is, and the way planned on it anew at every step."""
