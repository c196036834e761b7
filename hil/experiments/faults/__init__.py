"""Runs under single faults, drawn at random or each in each phase, and what they cover."""
