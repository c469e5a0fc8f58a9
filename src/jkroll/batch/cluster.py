"""Tables on the machines of a Dask cluster: a task each, given again to another worker when one is lost."""

import logging
import os
from collections.abc import Iterator
from contextlib import ExitStack

from distributed import Client, KilledWorker, LocalCluster, as_completed

from ..rows.header import BadTable
from ..text import quoted
from .lines import Tally
from .many import Done, convert_part
from .settings import Job, Part

LOCAL = "local"
WAIT = 20.0  # seconds for a scheduler to answer, and then for it to have a worker


def on_cluster(job: Job, parts: list[Part], processes: int) -> Iterator[tuple[Part, Done]]:
    """Convert parts at the scheduler of `--dask`; `local` starts one here. Yield each part as soon as it is done."""
    for name in ("distributed", "distributed.worker", "distributed.scheduler", "distributed.nanny", "tornado"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    with ExitStack() as until_the_end:
        client = until_the_end.enter_context(_connected(job.settings.dask, processes, until_the_end))
        futures = {client.submit(convert_part, job, _anywhere(part), pure=False): part for part in parts}
        for future in as_completed([*futures]):
            try:
                done = future.result()
            except KilledWorker as error:
                done = Done(Tally(), f"its worker ended {error.allowed_failures + 1} times", 1)
            yield futures[future], done


def _anywhere(part: Part) -> Part:
    """Return a part by its whole paths: a worker opens a relative one in a directory of its own."""
    return Part(*map(os.path.abspath, part))


def _connected(address: str, processes: int, until_the_end: ExitStack) -> Client:
    """Return a client of a scheduler that has a worker. Raises BadTable."""
    if address == LOCAL:
        try:
            cluster = LocalCluster(
                n_workers=processes, threads_per_worker=1, dashboard_address=None, silence_logs=logging.CRITICAL
            )
        except (OSError, RuntimeError) as error:
            raise BadTable(f"--dask local: no cluster can be started here: {error}") from None
        return Client(until_the_end.enter_context(cluster))
    try:
        client = Client(address, timeout=WAIT)
    except (OSError, ValueError):
        raise BadTable(f"--dask: no scheduler answers at {quoted(address)}") from None
    try:
        client.wait_for_workers(1, timeout=WAIT)
    except TimeoutError:
        client.close()
        raise BadTable(f"--dask: the scheduler at {quoted(address)} has no worker") from None
    return client
