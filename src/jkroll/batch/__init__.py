"""Tables of scenes: millions of rows in, the same rows with their results out.

From the bottom up:

columns, cells, materials   the header of a table; a column of texts as SI numbers; a column of materials
rows, single, task          a block of rows evaluated at once; a row by itself, with its words; the quantities to compute
dialect, delimited, ndjson  formats whose records are lines; `lines` is their interface
formats, settings           the registry of formats and compressions; the options of a run
source, journal, output     blocks of whole records; what a run has done so far; a file that appears when it is whole
workers, loop               processes; the loop that takes blocks through a converter into the output, in order
stream, parquet, sweep      a table of lines; Parquet; the rows of ranges, which no file holds
many, cluster               many tables, or the parts of a large one; Dask
command                     the `batch` command
"""

import os

os.environ.setdefault("ARROW_DEFAULT_MEMORY_POOL", "system")  # pyarrow's other pools keep more memory than they need
