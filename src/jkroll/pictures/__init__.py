"""Maps, curves and figures of the paper, drawn in a terminal and into files.

Data, from the bottom up: `axes`, `maps` and `regions` (a quantity over two inputs), `panels` (curves), `plot_request` (of a user),
`contact_curves` (of one contact), `figures`, `profiles` and `laws` (of the paper). Drawing: `canvas` and `terminal` for cells; `styles`, `mathtext`,
`page_axes`, `labels` and `page` for matplotlib.
"""
