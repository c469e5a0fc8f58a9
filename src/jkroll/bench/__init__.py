"""Speed against error of the ways to compute each quantity."""
