"""How fast the whole loop runs on this machine, and where its time goes."""
