"""Tables of scenes: millions of rows in, the same rows with their results out.

A table is read in blocks of whole records. `columns` says what its header means and `task` what is to be computed; `cells` and
`materials` read columns, `rows` evaluates a block at once, `single` a row by itself. `delimited`, `ndjson` and `parquet` are the
formats; `source`, `ring` and `output` carry blocks through several processes into a file that appears when it is whole, `pieces`
into one of Parquet. `parts`, `spans` and `cluster` do many tables and parts of large ones, `sweep` and `sweep_parquet` rows that
no file holds. Imported by `batch` and by long sweeps alone.
"""

import os

os.environ.setdefault("ARROW_DEFAULT_MEMORY_POOL", "system")  # what pyarrow has of its own keeps more than it needs
