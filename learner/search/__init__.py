"""Search and memory without learning: what any learner has to beat."""
