"""From what is given to what is asked."""
