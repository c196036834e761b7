"""What each channel carries: `encode` is cheap and runs in the loop, `fields` in the writer."""
