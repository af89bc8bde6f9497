"""Admits studies: a few at once, on the service's own workers or on a cluster."""

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
    from app.studies.cluster import DaskCluster

logger = logging.getLogger("tribodrive")


class StudyPool:
    """The service's own workers for one study, which shares them with others like one more client."""

    def __init__(self, workers: WorkerPool) -> None:
        self._workers = workers
        self.slots = workers.size

    def submit(self, function: Callable[..., Any], *arguments: Any) -> asyncio.Future[Any]:
        """Return the future of the result; it raises WorkerLost, DeadlineExceeded, and what the function raises."""
        return self._workers.submit(self, function, *arguments, is_single=False)


class StudyAdmission:
    """How many studies run at once, and the pool that solves their points."""

    def __init__(self, settings: Settings, workers: WorkerPool) -> None:
        self._settings = settings
        self._workers = workers
        self._running = 0
        self._cluster: DaskCluster | None = None
        if settings.scheduler:
            from app.studies import cluster  # noqa: PLC0415  an extra, and a second of imports

            self._cluster = cluster.DaskCluster(settings.scheduler, settings.study_deadline_s)

    @contextmanager
    def place(self) -> Iterator[None]:
        """Count a study among the running ones while the context is open; raises StudiesFull."""
        if self._running >= self._settings.studies:
            raise StudiesFull
        self._running += 1
        try:
            with STUDIES.track_inprogress():
                yield
        finally:
            self._running -= 1

    def own(self) -> Pool:
        """The service's own workers for one study; its figures are drawn there, even if a cluster solves its points."""
        return StudyPool(self._workers)

    async def pool(self) -> Pool:
        """Where points are solved; raises SchedulerUnavailable."""
        if self._cluster is None:
            return self.own()
        return await self._cluster.ready()

    @asynccontextmanager
    async def open(self) -> AsyncIterator[None]:
        """Prepare the cluster in the background while the context is open, so that the first study need not wait."""
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
