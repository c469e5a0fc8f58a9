"""Maps, curves and figures of the paper, drawn in a terminal and into files.

Data, from the bottom up: `axes`, `maps` and `regions` (a quantity over two inputs), `panels` (curves), `figures` and `profiles` (of
the paper and of one contact), `plot_request` (of a user). Drawing: `canvas` and `terminal` for cells; `styles`, `mathtext`,
`page_axes`, `labels` and `page` for matplotlib.
"""
