"""How many runs it takes to find a planted bug: estimator, hill climber, chance."""
