"""Looks for the worst that faults can do to a rig, and shrinks what it found to what matters."""
