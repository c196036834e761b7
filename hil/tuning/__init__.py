"""Finding a force law's parameters for a rig by a resumable search."""
