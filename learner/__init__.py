"""The assembly task as a Markov decision process, and who solves it."""
