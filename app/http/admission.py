"""Admission of studies: how many run at once, and on the service's own workers or on a cluster."""

import asyncio
import logging
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import asynccontextmanager, contextmanager
from typing import TYPE_CHECKING, Any

from app.errors import SchedulerUnavailable, StudiesFull
from app.log import STUDIES
from app.settings import Settings
from app.studies.runner import Pool
from app.workers.pool import Pool as WorkerPool

if TYPE_CHECKING:
    from app.workers.cluster import DaskCluster

logger = logging.getLogger("tribodrive")


class StudyPool:
    """The workers of the service, as used by one study, which counts as one client."""

    chunk_s = longest_s = 0.25
    ahead = 2

    def __init__(self, workers: WorkerPool) -> None:
        self._workers = workers
        self.slots = workers.size

    def submit(self, function: Callable[..., Any], *arguments: Any) -> asyncio.Future[Any]:
        """Call the function in a worker as soon as one is free, and return the future of its result."""
        return self._workers.submit(self, function, *arguments, is_single=False).outcome


class StudyAdmission:
    """Limit on the number of studies that run at once, and choice of the workers for a study."""

    def __init__(self, settings: Settings, workers: WorkerPool) -> None:
        self._settings = settings
        self._workers = workers
        self._running = 0
        self._cluster: DaskCluster | None = None
        if settings.scheduler:
            from app.workers import cluster  # noqa: PLC0415  Dask is an extra, and its import takes a second

            self._cluster = cluster.DaskCluster(settings.scheduler, settings.study_deadline_s)

    @contextmanager
    def place(self) -> Iterator[None]:
        """Count a study as running while the context is open. Raises StudiesFull if the limit is reached."""
        if self._running >= self._settings.studies:
            raise StudiesFull
        self._running += 1
        try:
            with STUDIES.track_inprogress():
                yield
        finally:
            self._running -= 1

    def own(self) -> Pool:
        """Return the workers of the service, which draw the figures of a study even if a cluster solves its points."""
        return StudyPool(self._workers)

    async def pool(self) -> Pool:
        """Return what solves the points of a study: the cluster of the settings, else the workers of the service.

        Raises SchedulerUnavailable if the cluster cannot be used.
        """
        if self._cluster is None:
            return self.own()
        return await self._cluster.ready()

    @asynccontextmanager
    async def open(self) -> AsyncIterator[None]:
        """Connect to the cluster in the background, for the first study; disconnect when the context closes."""
        preparation = asyncio.create_task(self._prepare())
        try:
            yield
        finally:
            preparation.cancel()
            if self._cluster is not None:
                await asyncio.to_thread(self._cluster.close)

    async def _prepare(self) -> None:
        try:
            await self.pool()
        except SchedulerUnavailable as error:
            logger.warning("%s; the next study tries again", error.detail)
