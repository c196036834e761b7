"""Force control and the phases of an assembly, on top of `drivers.interfaces` alone."""
