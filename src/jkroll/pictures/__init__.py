"""Maps, curves and figures of the paper, drawn in a terminal and into files.

Data, from the bottom up: `axes`, `styles`, `maps` (a quantity over two inputs, and curves), `request` (of a user),
`curves` (of one contact), `figures` (of the paper). Drawing: `terminal` writes tables; `labels` and `page` draw with
matplotlib.
"""
