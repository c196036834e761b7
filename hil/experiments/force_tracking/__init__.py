"""The paper's force-tracking experiment (Section 3.4, Figs. 5 and 6) over the wire."""
