"""Hardware-in-the-loop testbed: the emulated cell (`hil.cell`) and the tools around it."""
