"""Tables in files: rows in, the same rows with their results out. What a row means stands in `model.rows`."""

import os

os.environ.setdefault("ARROW_DEFAULT_MEMORY_POOL", "system")  # pyarrow's other pools keep more memory than they need
