"""Tables on the machines of a Dask cluster: a task each, given again to another worker when one is lost."""

import logging
from collections.abc import Iterator
from contextlib import ExitStack

from distributed import Client, LocalCluster, as_completed

from ..table.errors import BadTable
from ..text import quoted
from .many import Done, convert_part
from .settings import Order
from .source import Part

LOCAL = "local"
WAIT = 20.0  # seconds for a scheduler to answer


def on_cluster(order: Order, parts: list[Part], jobs: int) -> Iterator[tuple[Part, Done]]:
    """Convert parts at the scheduler of `--dask`; `local` starts one here. Yield each part as soon as it is done."""
    address = order.settings.dask
    for name in ("distributed", "distributed.worker", "distributed.scheduler", "distributed.nanny", "tornado"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    with ExitStack() as until_the_end:
        if address == LOCAL:
            cluster = LocalCluster(
                n_workers=jobs, threads_per_worker=1, dashboard_address=None, silence_logs=logging.CRITICAL
            )
            client = until_the_end.enter_context(Client(until_the_end.enter_context(cluster)))
        else:
            try:
                client = until_the_end.enter_context(Client(address, timeout=WAIT))
            except (OSError, ValueError):
                raise BadTable(f"--dask: no scheduler answers at {quoted(address)}") from None
        futures = {client.submit(convert_part, order, part, pure=False): part for part in parts}
        for future, done in as_completed([*futures], with_results=True):
            yield futures[future], done
