"""Scenes that are asked together: the rows of a list or a table, and the results, doubts and reasons of each.

From the bottom up:

reasons            why cells are empty: a phrase for the status, and in full; the counts of such rows
columns            what is wanted of rows, and their columns: by floats, which defines them, and by arrays
cells              a column of texts as SI numbers, or as materials
words              the words of headers as data, and their units
header             the meaning of one header, and all columns of a table, with those of error bars
rows               rows that are computed together, which are scenes of arrays as far as they are alike
sweep              the rows of lists and ranges
infer              the same where an input is sought, and the rows of arrays from Python
table              the rows of a table

No file is opened here: `batch` reads and writes.
"""
