"""The search task without robot or physics: thousands of episodes a minute."""
