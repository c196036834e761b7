"""What can be broken in a cell, when, and what is known of it: no device, no socket in here."""
