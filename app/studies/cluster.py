"""Studies on a Dask cluster: the same chunks, sent to its workers instead of the service's own processes.

Only this module knows Dask, which is an extra: `pip install 'tribodrive[dask]'`.
"""

import asyncio
import platform
from collections.abc import Callable
from importlib.metadata import version
from typing import Any

from distributed import Client, KilledWorker

from app.errors import SchedulerUnavailable, WorkerLost
from app.sources import SOURCES
from app.studies.engine import PoolLost
from app.workers.stages import STAGES, warm

CONNECT_S = 10.0
WATCH_S = 0.5
PACKAGES = ("tribodrive", "numpy", "scipy", "numba", "pydantic")  # what the numbers depend on
LOST = "the Dask scheduler is gone; start the study again"


class DaskCluster:
    """A Dask cluster whose workers run our versions with warm kernels."""

    def __init__(self, address: str) -> None:
        self._address = address
        self._client: Client | None = None
        self._prepared: set[str] = set()
        self._connecting = asyncio.Lock()
        self.slots = 1

    async def ready(self) -> "DaskCluster":
        """The cluster, connected and every worker prepared; raises SchedulerUnavailable."""
        async with self._connecting:
            try:
                await asyncio.to_thread(self._prepare)
            except (OSError, TimeoutError, ValueError, RuntimeError) as error:
                await asyncio.to_thread(self.close)
                raise SchedulerUnavailable(f"The Dask scheduler cannot be used: {error}") from error
        return self

    def _prepare(self) -> None:
        """Connect; compare versions and warm kernels on every worker that is new. Blocks."""
        if self._client is None or self._client.status != "running":
            self.close()
            self._client = Client(self._address, timeout=CONNECT_S, set_as_default=False)
        threads = self._client.nthreads()
        if not threads:
            raise ValueError("it has no workers")
        new = set(threads) - self._prepared
        calls = [self._client.submit(prepare, workers=[each], pure=False, retries=0) for each in new]
        for theirs in self._client.gather(calls):
            if theirs != versions():
                raise ValueError(f"its workers run {theirs}, the service {versions()}")
        self._prepared |= new
        self.slots = sum(threads.values())

    def submit(self, function: Callable[..., Any], *arguments: Any) -> asyncio.Future[Any]:
        """Send a call; cancelling takes it back if it has not begun."""
        return asyncio.ensure_future(self._result(function, *arguments))

    async def _result(self, function: Callable[..., Any], *arguments: Any) -> Any:
        client = self._client
        if client is None or client.status != "running":
            raise PoolLost(LOST)
        future = client.get_executor(pure=False, retries=0).submit(function, *arguments)
        try:
            while not future.done():
                await asyncio.wait({asyncio.wrap_future(future)}, timeout=WATCH_S)
                if client.status != "running":
                    raise PoolLost(LOST)
            return future.result()
        except KilledWorker as error:
            raise WorkerLost from error
        finally:
            future.cancel()

    def close(self) -> None:
        """Leave the cluster. Blocks."""
        self._prepared.clear()
        if self._client is not None:
            self._client.close(timeout=1)
            self._client = None


def prepare() -> dict[str, str]:
    """Load every kernel; runs in a worker and answers its versions."""
    for stage in STAGES:
        warm(stage)
    return versions()


def versions() -> dict[str, str]:
    """What the numbers depend on."""
    return {
        "python": platform.python_version(),
        "sources": SOURCES,
        **{package: version(package) for package in PACKAGES},
    }
