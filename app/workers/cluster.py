"""Studies on a Dask cluster: kernels for its workers, and the service's own connection to it.

Only this module imports Dask. Dask is an optional dependency: `pip install 'tribodrive[dask]'`. TLS is the matter of
Dask's own configuration.
"""

import asyncio
import platform
from collections.abc import Callable
from importlib.metadata import version
from typing import Any

from distributed import Client, KilledWorker, Worker, WorkerPlugin

from app.calculations import BY_PATH
from app.errors import PoolLost, SchedulerUnavailable, WorkerLost
from app.evaluate import warm
from app.models.kernels import KERNEL_GROUPS
from app.sources import SOURCES

CONNECT_S = 10.0  # longest time of one call to the scheduler
ANSWER_S = 15.0  # longest time of the first two calls together: one call connects, the other lists the workers
WATCH_S = 0.5  # during a call, the connection to the scheduler is checked at intervals of this length
PACKAGES = ("tribodrive", "numpy", "scipy", "numba", "pydantic")  # packages whose versions change the results
LOST = "the connection to the Dask scheduler is lost; start the study again"


class Kernels(WorkerPlugin):
    """Compiles the kernels of calculations in every worker of a cluster, also in one that joins later, or loads them.

    A worker with other sources than the client joins without them: studies refuse it.

    Parameters
    ----------
    *endpoints : str
        Addresses of the calculations, such as "/v1/drive-train". By default all.
    """

    name = "tribodrive-kernels"

    def __init__(self, *endpoints: str) -> None:
        self.endpoints = endpoints
        self.sources = SOURCES

    async def setup(self, worker: Worker) -> None:
        """Load the kernels in the thread that solves, so that the worker goes on answering the scheduler."""
        if self.sources == SOURCES:
            await asyncio.get_running_loop().run_in_executor(worker.executors["default"], self.load)

    def load(self) -> None:
        """Load the kernels into this process."""
        named = {group for endpoint in self.endpoints for group in BY_PATH[endpoint].kernels.of()}
        for group in KERNEL_GROUPS:
            if group in named or not self.endpoints:
                warm(group)


class DaskCluster:
    """The cluster at an address. Its workers must have the package versions of this service."""

    chunk_s, longest_s, ahead = 0.5, 2.0, 2

    def __init__(self, address: str, deadline_s: float) -> None:
        self._address = address
        self._deadline_s = deadline_s
        self._client: Client | None = None
        self._checked: set[str] = set()
        self._preparation: asyncio.Task[None] | None = None
        self._answered = False
        self.slots = 1

    async def ready(self) -> "DaskCluster":
        """Wait until the cluster is connected and its workers are prepared, and return the cluster.

        Raises SchedulerUnavailable if the scheduler does not answer or cannot be used, or if the preparation takes too
        long. A call to the scheduler cannot be cancelled: the preparation continues after the error. Only one runs at
        a time.
        """
        if self._preparation is None or self._preparation.done():
            self._answered = False
            self._preparation = asyncio.create_task(self._prepared_or_closed())
        await asyncio.wait({self._preparation}, timeout=ANSWER_S)
        if not self._preparation.done() and not self._answered:
            raise SchedulerUnavailable(f"The Dask scheduler did not answer within {ANSWER_S:g} s")
        await asyncio.wait({self._preparation}, timeout=self._deadline_s)
        if not self._preparation.done():
            raise SchedulerUnavailable("The workers of the Dask cluster are still being prepared")
        self._preparation.result()
        return self

    async def _prepared_or_closed(self) -> None:
        try:
            await asyncio.to_thread(self._prepare)
        except (OSError, TimeoutError, ValueError, RuntimeError) as error:
            await asyncio.to_thread(self.close)
            reason = str(error) or f"it did not answer within {CONNECT_S:g} s"
            raise SchedulerUnavailable(f"The Dask scheduler cannot be used: {reason}") from error

    def _prepare(self) -> None:
        """Connect to the scheduler, check the versions of new workers, and have kernels loaded. This call blocks."""
        if self._client is None or self._client.status != "running":
            self.close()
            self._client = Client(self._address, timeout=CONNECT_S, set_as_default=False)
        assert self._client.scheduler is not None
        threads = self._client.sync(self._client.scheduler.ncores, callback_timeout=CONNECT_S)
        self._answered = True
        if not threads:
            raise ValueError("it has no workers")
        for worker, theirs in self._client.run(versions, workers=[*set(threads) - self._checked]).items():
            if theirs != versions():
                raise ValueError(f"its worker {worker} has other versions {theirs} than the service {versions()}")
        if not self._checked:
            self._client.register_plugin(Kernels())
        self._checked |= set(threads)
        self.slots = sum(threads.values())

    def submit(self, function: Callable[..., Any], *arguments: Any) -> asyncio.Future[Any]:
        """Send a call to the cluster and return the future of its result. Dask repeats it if its worker is lost."""
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
        """Disconnect from the cluster. This call blocks."""
        self._checked.clear()
        if self._client is not None:
            self._client.close(timeout=1)
            self._client = None


def versions() -> dict[str, str]:
    """Return the versions on which results depend: those of Python, of the solvers and of `PACKAGES`."""
    return {
        "python": platform.python_version(),
        "sources": SOURCES,
        **{package: version(package) for package in PACKAGES},
    }
