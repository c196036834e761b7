"""Q-learning on the poses of the search box: plain, double, and weighted double (Eqs. 5 to 7)."""
