"""Maps, curves and figures of the paper, drawn in a terminal and into files."""
