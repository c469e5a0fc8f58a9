"""Names, units, and the way between text and SI numbers."""
