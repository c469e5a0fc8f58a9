"""Names of quantities, units, and conversion between text and SI numbers."""
