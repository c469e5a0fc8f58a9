"""Scenes that are asked together: the rows of a list or a table, and the results, doubts and reasons of each.

From the bottom up:

reasons            why cells are empty: a phrase for the status, and in full; the counts of rows
columns            what is wanted of rows, and their columns: by floats, which defines them, and by arrays
inferred           the same where an input is sought
words, readings    the words of headers as data, and the meaning of one header
sides, header      the columns of error bars, and all columns of a table
cells              a column of texts as SI numbers
block, rows        rows that are computed together, which are scenes of arrays as far as they are alike
sweep              the rows of lists and ranges
table              the rows of a table
infer              the rows of arrays from Python, where an input is sought

No file is opened here: `batch` reads and writes.
"""
