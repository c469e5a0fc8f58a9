"""Maps, curves and figures of the paper, drawn in a terminal and into files.

Data, from the bottom up: `picture` (axes, curves, fields, looks), `request` (of a user), `curves` (of one contact),
`figures` (of the paper). Drawing: `terminal` writes tables; `page` draws with matplotlib.
"""
