"""The fit of measured force curves: the contact's work of adhesion and moduli, with their errors."""
