"""The fit of measured force curves: work of adhesion, contact modulus and contact point, with their errors."""
