"""The meaning of a table of scenes: its header, the cells of a block of rows as numbers, and the results and the status of each row.

From the bottom up:

columns, cells, materials      the header; a column of texts as SI numbers; a column of materials
task, blocks                   the quantities to compute; a block of rows, and the results of rows
groups, evaluated, evaluator   the rows of a block that share a scene; the results of a scene; those of a whole block

No file is opened here: `batch` reads and writes.
"""
