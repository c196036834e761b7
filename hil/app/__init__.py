"""Composition root of both sides: a served cell, drivers connected to it, a job, a recording."""
