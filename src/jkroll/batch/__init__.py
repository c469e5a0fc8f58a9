"""Tables of scenes in files: millions of rows in, the same rows with their results out. What a row means stands in `table`.

From the bottom up:

lines, delimited, ndjson    the formats whose records are lines: what they have in common; CSV and TSV; NDJSON
formats, settings           the registry of formats and compressions; the options of a run
asked                       what the header, the first rows and the options ask for
source                      the input as blocks of whole records
journal, output             the state of a run, for `--resume`; a file that appears when it is whole
progress, workers, loop     the bar; processes; the loop that takes blocks through a converter into the output, in order
stream, parquet, sweep      a table of lines; Parquet; the rows of ranges, which no file holds
many, cluster               many tables, or the parts of a large one; Dask
command                     the `batch` command
"""

import os

os.environ.setdefault("ARROW_DEFAULT_MEMORY_POOL", "system")  # pyarrow's other pools keep more memory than they need
