"""Admits studies: a few at once, on the service's own workers or on a cluster."""

import asyncio
import logging
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager
from typing import TYPE_CHECKING

from app.errors import SchedulerUnavailable, StudiesFull
from app.log import STUDIES
from app.settings import Settings
from app.studies.engine import Pool
from app.workers.pool import Pool as WorkerPool
from app.workers.pool import StudyPool

if TYPE_CHECKING:
    from app.studies.cluster import DaskCluster

logger = logging.getLogger("tribodrive")


def _cluster(address: str, deadline_s: float) -> "DaskCluster":
    from app.studies.cluster import DaskCluster  # noqa: PLC0415  an extra, and a second of imports

    return DaskCluster(address, deadline_s)


class StudyAdmission:
    """How many studies run at once, and the pool that solves their points."""

    def __init__(self, settings: Settings, workers: WorkerPool) -> None:
        self._most = settings.studies
        self._settings = settings
        self._workers = workers
        self._cluster = _cluster(settings.scheduler, settings.study_deadline_s) if settings.scheduler else None
        self._running = 0

    @contextmanager
    def place(self) -> Iterator[None]:
        """Count a study among the running ones while the context is open; raises StudiesFull."""
        if self._running >= self._most:
            raise StudiesFull
        self._running += 1
        STUDIES.set(self._running)
        try:
            yield
        finally:
            self._running -= 1
            STUDIES.set(self._running)

    def own(self) -> Pool:
        """The service's own workers for one study; its figures are drawn there, even if a cluster solves its points."""
        return StudyPool(self._settings, self._workers)

    async def pool(self) -> Pool:
        """Where points are solved; raises SchedulerUnavailable."""
        if self._cluster is None:
            return self.own()
        return await self._cluster.ready()

    @asynccontextmanager
    async def open(self) -> AsyncIterator[None]:
        """Prepare the cluster in the background while the context is open, so that the first study need not wait."""
        if self._cluster is None:
            yield
            return
        preparation = asyncio.create_task(_prepare(self._cluster))
        try:
            yield
        finally:
            preparation.cancel()
            await asyncio.to_thread(self._cluster.close)


async def _prepare(cluster: "DaskCluster") -> None:
    try:
        await cluster.ready()
    except SchedulerUnavailable as error:
        logger.warning("%s; the next study tries again", error.detail)
