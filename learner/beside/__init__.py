"""A learner in a process of its own beside a real control loop, joined by shared memory.

The control process reads one byte a search step and writes one record; it never waits and runs no
other thread. Six Python threads in its own process, as Algorithm 1 has them, missed 92 % of the
deadlines of a 125 Hz loop on two shared cores.
"""
