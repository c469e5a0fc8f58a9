"""Tables in files: the rows of a table come back with their results. `model.rows` gives rows their meaning."""

import os

os.environ.setdefault("ARROW_DEFAULT_MEMORY_POOL", "system")  # pyarrow's other pools keep more memory than they need
