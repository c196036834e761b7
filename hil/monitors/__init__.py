"""Properties over what a run showed: a past-time temporal language, live and offline."""
