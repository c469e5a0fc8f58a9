"""Maps, curves and figures of the paper, drawn in a terminal and into files.

Data, from the bottom up: `axes`, `styles`, `maps` (a quantity over two inputs, and curves), `request` (of a user, or of
a map of the paper), `curves` (of one contact, and those of the paper). Drawing: `terminal` for cells; `page_axes` and
`page` for matplotlib.
"""
