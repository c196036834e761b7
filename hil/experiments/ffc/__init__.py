"""Section 4 of the paper through the whole cell: 48 training episodes, two with another cable."""
