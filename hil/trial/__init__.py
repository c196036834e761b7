"""One run under faults, with its verdict: what happened, what it shows, whether it was safe."""
