"""Fuzz targets: every decoder and interpreter, each held to its own error and to bounded memory."""
