"""Materials and the files that describe them."""
