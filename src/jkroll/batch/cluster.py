"""Tables on the machines of a Dask cluster: a task each, given again to another worker when one is lost."""

import logging
from collections.abc import Iterator

from distributed import Client, LocalCluster, as_completed

from ..text import quoted
from .errors import BadTable
from .parts import Part, convert_part
from .settings import Tally

LOCAL = "local"
WAIT = 20.0  # seconds for a scheduler to answer


def on_cluster(address: str, workers: int) -> "_Runner":
    """What runs parts at a scheduler; `local` starts one here, with as many workers."""
    return _Runner(address, workers)


class _Runner:
    def __init__(self, address: str, workers: int) -> None:
        self.address, self.workers = address, workers

    def __call__(self, parts: list[Part]) -> Iterator[tuple[Part, Tally]]:
        """Convert parts wherever there is room; each that is done, as soon as it is."""
        for name in ("distributed", "distributed.worker", "distributed.scheduler", "distributed.nanny", "tornado"):
            logging.getLogger(name).setLevel(logging.CRITICAL)
        if self.address == LOCAL:
            with (
                LocalCluster(
                    n_workers=self.workers, threads_per_worker=1, dashboard_address=None, silence_logs=logging.CRITICAL
                ) as cluster,
                Client(cluster) as client,
            ):
                yield from _run(client, parts)
            return
        try:
            client = Client(self.address, timeout=WAIT)
        except (OSError, ValueError):
            raise BadTable(f"--dask: no scheduler answers at {quoted(self.address)}") from None
        with client:
            yield from _run(client, parts)


def _run(client: Client, parts: list[Part]) -> Iterator[tuple[Part, Tally]]:
    """Each part in one process: the workers are as many as there are to be."""
    futures = {}
    for part in parts:
        alone = part._replace(settings=part.settings._replace(jobs=1))
        key = f"jkroll-{part.target}-{part.identity[:16]}"
        futures[client.submit(convert_part, alone, key=key, pure=False)] = part
    for future, tally in as_completed([*futures], with_results=True):
        yield futures[future], Tally(*tally)
