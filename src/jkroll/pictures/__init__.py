"""Maps, curves and figures, in a terminal and as files."""
