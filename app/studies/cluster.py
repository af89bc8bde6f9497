"""Studies on a Dask cluster: the same chunks, sent to its workers instead of the service's own processes.

Only this module knows Dask, which is an extra (`pip install 'tribodrive[dask]'`).
"""

import asyncio
from collections.abc import Callable
from concurrent.futures import CancelledError as FutureCancelled
from typing import Any

from distributed import Client, KilledWorker
from distributed.comm import CommClosedError

from app.problems import WorkerLost
from app.responses.common import MODEL_VERSION
from app.studies.engine import PoolLost
from app.studies.points import Chunk
from app.warm_up import warm_up

CONNECT_SECONDS = 10.0


class ClusterUnusable(Exception):
    """The scheduler cannot be reached, or its workers run another version."""


class Cluster:
    """A Dask cluster whose workers run this version with warm kernels."""

    def __init__(self, address: str) -> None:
        """Connect, compare versions, warm the kernels of every worker; blocks, so it belongs into a thread."""
        try:
            self._client = Client(address, timeout=CONNECT_SECONDS, set_as_default=False)
            self._client.get_versions(check=True)
        except (OSError, TimeoutError, ValueError) as error:
            raise ClusterUnusable(f"the Dask scheduler at {address} cannot be used: {error}") from error
        others = {version for version in self._client.run(_version).values() if version != MODEL_VERSION}
        if others:
            self.close()
            raise ClusterUnusable(f"Dask workers run version {', '.join(sorted(others))}, not {MODEL_VERSION}")
        self._client.run(warm_up)
        self._executor = self._client.get_executor(pure=False, retries=0)

    @property
    def slots(self) -> int:
        """Threads of all workers that are there now."""
        return max(1, sum(self._client.nthreads().values()))

    def submit(self, function: Callable[..., Chunk], *args: Any) -> "asyncio.Future[Chunk]":
        """Send a chunk; losses become the engine's own exceptions."""
        return asyncio.ensure_future(self._result(function, *args))

    async def _result(self, function: Callable[..., Chunk], *args: Any) -> Chunk:
        if self._client.status != "running":
            raise PoolLost("the Dask scheduler is gone; start the study again")
        future = self._executor.submit(function, *args)
        try:
            return await asyncio.wrap_future(future)
        except KilledWorker as error:
            raise WorkerLost from error
        except (CommClosedError, FutureCancelled, asyncio.CancelledError) as error:
            if not future.cancelled():
                raise
            raise PoolLost("the Dask scheduler is gone; start the study again") from error

    def close(self) -> None:
        """Leave the cluster."""
        self._client.close(timeout=1)


def _version() -> str:
    return MODEL_VERSION
