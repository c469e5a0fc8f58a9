"""Tables of scenes in files: rows in, the same rows with their results out. What a row means stands in `rows`.

From the bottom up:

lines                       what formats have in common: heads of tables, blocks taken apart, the counts of a run
delimited, ndjson           the formats whose records are lines: CSV and TSV; NDJSON
decimals                    decimal commas
job                         the options of a run, and the table that they make of a header
files                       formats and compressions; the input as blocks of whole records; the output
parquet                     Parquet
progress, workers, run      the bar; processes; the loop that takes blocks through a converter into the output, in order
many                        many tables, by processes or on a Dask cluster
command                     the `batch` command
"""

import os

os.environ.setdefault("ARROW_DEFAULT_MEMORY_POOL", "system")  # pyarrow's other pools keep more memory than they need
