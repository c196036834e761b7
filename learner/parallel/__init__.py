"""Algorithm 1 of the paper: one real robot and n simulated agents on a shared experience pool."""
