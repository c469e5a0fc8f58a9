"""Tables on the machines of a Dask cluster: a task each, given again to another worker when one is lost."""

import logging
from collections.abc import Iterator

from distributed import Client, LocalCluster, as_completed

from ..text import quoted
from .errors import BadTable
from .many import Done, Part, convert_part
from .settings import Order

LOCAL = "local"
WAIT = 20.0  # seconds for a scheduler to answer


def on_cluster(order: Order, parts: list[Part]) -> Iterator[tuple[Part, Done]]:
    """Convert parts at the scheduler of `--dask`; `local` starts one here. Yield each part as soon as it is done."""
    address = order.settings.dask
    for name in ("distributed", "distributed.worker", "distributed.scheduler", "distributed.nanny", "tornado"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    if address == LOCAL:
        with (
            LocalCluster(
                n_workers=order.settings.processes,
                threads_per_worker=1,
                dashboard_address=None,
                silence_logs=logging.CRITICAL,
            ) as cluster,
            Client(cluster) as client,
        ):
            yield from _run(client, order, parts)
        return
    try:
        client = Client(address, timeout=WAIT)
    except (OSError, ValueError):
        raise BadTable(f"--dask: no scheduler answers at {quoted(address)}") from None
    with client:
        yield from _run(client, order, parts)


def _run(client: Client, order: Order, parts: list[Part]) -> Iterator[tuple[Part, Done]]:
    futures = {client.submit(convert_part, order, part, pure=False): part for part in parts}
    for future, (tally, *others) in as_completed([*futures], with_results=True):
        yield futures[future], Done(tally, *others)
