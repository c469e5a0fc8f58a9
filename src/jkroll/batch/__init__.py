"""Tables of scenes: millions of rows in, the same rows with their results out.

A table is read in blocks of whole records. `columns` says what the header means, `cells` reads a column, `rows` evaluates a
block, `delimited` and `ndjson` take a block apart and put it together again, `ring` keeps several processes in order,
`output` writes beside the result and remembers how far it came. Imported by the `batch` command alone.
"""
