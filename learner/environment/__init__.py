"""The search task as a gymnasium environment, over any world of `learner.worlds`' interface."""
