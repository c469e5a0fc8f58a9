"""Tables of scenes in files: rows in, the same rows with their results out. What a row means stands in `rows`.

From the bottom up:

lines       CSV, TSV and NDJSON: headers read, blocks of records taken apart
files       formats and compressions by the names of files; the input as blocks of whole records
run         the options of a run; the loop that takes blocks through a converter into the output, in order
parquet     Parquet
workers     processes
command     the `batch` command, of one table or of many, by processes or on a Dask cluster
"""

import os

os.environ.setdefault("ARROW_DEFAULT_MEMORY_POOL", "system")  # pyarrow's other pools keep more memory than they need
