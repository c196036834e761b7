"""Random closed loops around a force law: the campaign behind its safety envelope."""
