"""Speed against error of the ways to each number."""
