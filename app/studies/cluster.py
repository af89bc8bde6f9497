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
from app.studies.runner import OtherSources, PoolLost
from app.workers.stages import STAGES, warm

CONNECT_S = 10.0  # for one call to the scheduler
ANSWER_S = 15.0  # for both, to connect and to name the workers
WARM_S = 600.0  # within which workers load their kernels, compiled if need be
WATCH_S = 0.5  # between two looks at a point that is being solved elsewhere
PACKAGES = ("tribodrive", "numpy", "scipy", "numba", "pydantic")  # what the numbers depend on
LOST = "the connection to the Dask scheduler is lost; start the study again"


class DaskCluster:
    """A Dask cluster whose workers run our versions with warm kernels."""

    def __init__(self, address: str, deadline_s: float) -> None:
        self._address = address
        self._deadline_s = deadline_s
        self._client: Client | None = None
        self._prepared: set[str] = set()
        self._preparation: asyncio.Task[None] | None = None
        self._answered = False
        self.slots = 1

    async def ready(self) -> "DaskCluster":
        """The cluster, connected and every worker prepared; raises SchedulerUnavailable.

        One preparation runs at a time and goes on when a study that waits for it is refused: calls to a scheduler that
        does not answer cannot be taken back.
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
        """Connect; compare versions and warm kernels on every worker that is new. Blocks."""
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
                raise ValueError(f"its worker {worker} runs {theirs}, but the service runs {versions()}")
        self._call_on(prepare, new)
        self._prepared |= new
        self.slots = sum(threads.values())

    def _call_on(self, function: Callable[[], Any], workers: set[str]) -> dict[str, Any]:
        """Call a function on each of the workers, wait, and return the result of each worker."""
        assert self._client is not None
        calls = {each: self._client.submit(function, workers=[each], pure=False, retries=0) for each in workers}
        return {worker: call.result(timeout=WARM_S) for worker, call in calls.items()}

    def submit(self, function: Callable[..., Any], *arguments: Any) -> asyncio.Future[Any]:
        """Send a call; cancelling takes it back if it has not begun."""
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
        """Leave the cluster. Blocks."""
        self._prepared.clear()
        if self._client is not None:
            self._client.close(timeout=1)
            self._client = None


def prepare() -> None:
    """Load all kernels into the worker that runs this function."""
    for stage in STAGES:
        warm(stage)


def solved_with(sources: str, function: Callable[..., Any], *arguments: Any) -> Any:
    """The call's result; runs in a worker, perhaps one that joined during the study.

    Raises OtherSources where the worker's solvers are not those whose digest the answers carry.
    """
    if sources != SOURCES:
        raise OtherSources(
            f"a Dask worker has version {SOURCES} of the solvers' sources, but the service has version {sources}; "
            "update the worker"
        )
    return function(*arguments)


def versions() -> dict[str, str]:
    """What the numbers depend on."""
    return {
        "python": platform.python_version(),
        "sources": SOURCES,
        **{package: version(package) for package in PACKAGES},
    }
