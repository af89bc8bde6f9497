"""Studies on a Dask cluster: the workers of the cluster solve the points, and the service's own workers do not.

Only this module imports Dask. Dask is an optional dependency: `pip install 'tribodrive[dask]'`.
"""

import asyncio
import platform
from collections.abc import Callable
from importlib.metadata import version
from typing import Any

from distributed import Client, KilledWorker

from app.errors import SchedulerUnavailable, WorkerLost
from app.evaluate import warm
from app.models.kernels import KERNEL_GROUPS
from app.sources import SOURCES
from app.studies.runner import OtherSources, PoolLost

CONNECT_S = 10.0  # longest time of one call to the scheduler
ANSWER_S = 15.0  # longest time of the first two calls together: one call connects, the other lists the workers
WARM_S = 600.0  # longest time in which a worker loads its kernels; the worker may have to compile the kernels first
WATCH_S = 0.5  # during a call, the connection to the scheduler is checked at intervals of this length
PACKAGES = ("tribodrive", "numpy", "scipy", "numba", "pydantic")  # packages whose versions change the results
LOST = "the connection to the Dask scheduler is lost; start the study again"


class DaskCluster:
    """A Dask cluster. Its workers must have the same package versions as this service.

    Every worker loads the kernels of the solvers before it solves points.
    """

    def __init__(self, address: str, deadline_s: float) -> None:
        self._address = address
        self._deadline_s = deadline_s
        self._client: Client | None = None
        self._prepared: set[str] = set()
        self._preparation: asyncio.Task[None] | None = None
        self._answered = False
        self.slots = 1

    async def ready(self) -> "DaskCluster":
        """Wait until the cluster is connected and every worker is prepared, and return the cluster.

        Raises SchedulerUnavailable if the scheduler cannot be used or does not answer in time, or if the preparation of
        the workers takes too long. A call to the scheduler cannot be cancelled. When time runs out, the preparation
        therefore continues after the error. Only one preparation runs at a time.
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
        """Connect to the scheduler, check the versions of all new workers, and load the kernels in these workers.

        This call blocks.
        """
        if self._client is None or self._client.status != "running":
            self.close()
            self._client = Client(self._address, timeout=CONNECT_S, set_as_default=False)
        assert self._client.scheduler is not None
        threads = self._client.sync(self._client.scheduler.ncores, callback_timeout=CONNECT_S)
        self._answered = True
        if not threads:
            raise ValueError("it has no workers")
        new = set(threads) - self._prepared
        for worker, theirs in self._call_on(versions, new).items():
            if theirs != versions():
                raise ValueError(f"its worker {worker} has other versions {theirs} than the service {versions()}")
        self._call_on(prepare, new)
        self._prepared |= new
        self.slots = sum(threads.values())

    def _call_on(self, function: Callable[[], Any], workers: set[str]) -> dict[str, Any]:
        """Call a function on each of the workers, and wait for the results. Return a result for each worker."""
        assert self._client is not None
        calls = {name: self._client.submit(function, workers=[name], pure=False, retries=0) for name in workers}
        return {name: call.result(timeout=WARM_S) for name, call in calls.items()}

    def submit(self, function: Callable[..., Any], *arguments: Any) -> asyncio.Future[Any]:
        """Send a call to the cluster and return a future of the call's result.

        If the future is cancelled before the call has begun, the call is also cancelled.
        """
        return asyncio.ensure_future(self._result(function, *arguments))

    async def _result(self, function: Callable[..., Any], *arguments: Any) -> Any:
        client = self._client
        if client is None or client.status != "running":
            raise PoolLost(LOST)
        future = client.get_executor(pure=False, retries=0).submit(solved_with, SOURCES, function, *arguments)
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
        self._prepared.clear()
        if self._client is not None:
            self._client.close(timeout=1)
            self._client = None


def prepare() -> None:
    """Load all kernels into the worker that runs this function."""
    for group in KERNEL_GROUPS:
        warm(group)


def solved_with(sources: str, function: Callable[..., Any], *arguments: Any) -> Any:
    """Call a function in a worker of the cluster and return the result of the function.

    `sources` is the hash of the source code of the service's solvers. Raises OtherSources if the worker's solvers have
    another hash, because answers state the hash of the service. Every call checks the hash, because a worker may join
    the cluster during the study.
    """
    if sources != SOURCES:
        raise OtherSources(
            f"a Dask worker has other solvers (hash {SOURCES}) than the service (hash {sources}); update the worker"
        )
    return function(*arguments)


def versions() -> dict[str, str]:
    """Return the versions on which the results depend: the versions of Python, of the solvers and of `PACKAGES`."""
    return {
        "python": platform.python_version(),
        "sources": SOURCES,
        **{package: version(package) for package in PACKAGES},
    }
