"""Tables in files and in Python: each row comes back with its results, which `model.rows` computes."""

import os

os.environ.setdefault("ARROW_DEFAULT_MEMORY_POOL", "system")  # pyarrow's other pools keep more memory than they need
