"""Speed against error of the ways to compute six quantities."""
