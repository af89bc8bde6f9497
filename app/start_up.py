"""From an empty cache to everything warm while the port is open: compile beside, load, open stage after stage."""

import asyncio
import contextlib
import logging
import os
import time
from collections import Counter
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager

from app.problems import WarmingUp
from app.progress import Progress
from app.warm_up import STAGES, TRACKS, Stage, content, needed_for
from app.workers.pool import Pool
from solvers.kernel_cache import is_complete, mark_complete, writable_root

logger = logging.getLogger("tribodrive")


class StartUp:
    """What is warm, what is not, and the work that changes it."""

    def __init__(self, pool: Pool) -> None:
        self._pool = pool
        self._compiled: Counter[str] = Counter()
        self._kept: set[Stage] = set()
        self._warm: list[Stage] = []
        self._loading = asyncio.Lock()
        self._progress = Progress([stage.name for stage in STAGES])
        self._began = time.monotonic()

    @asynccontextmanager
    async def running(self) -> AsyncIterator[None]:
        """Warm up in the background while the context is open; leaving it ends what still runs."""
        task = asyncio.create_task(self._run())
        try:
            yield
        finally:
            task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await task

    @property
    def warm(self) -> list[str]:
        """Names of the stages that answer."""
        return [stage.name for stage in self._warm]

    @property
    def complete(self) -> bool:
        """Whether every stage answers."""
        return len(self._warm) == len(STAGES)

    def report(self) -> str:
        """How far everything is, in words."""
        return ", ".join(f"{stage.name} {100 * self._share(stage):.0f} %" for stage in STAGES)

    def require(self, endpoint: str) -> None:
        """Raise WarmingUp if the endpoint's kernels are not there yet."""
        if not self.complete and needed_for(endpoint) not in self._warm:
            raise self._warming_up()

    def require_any(self) -> None:
        """Raise WarmingUp if there is no worker yet that could look at a request."""
        if not self._warm:
            raise self._warming_up()

    def _warming_up(self) -> WarmingUp:
        return WarmingUp(f"Kernels are being compiled, once after installation: {self.report()}")

    async def _run(self) -> None:
        try:
            if is_complete(content()):
                await self._load_all()
            elif writable_root() is None:
                logger.warning("no folder for compiled kernels can be written: they are compiled in memory")
                await self._load_all()
            else:
                await self._compile()
            self._progress.finish(f"tribodrive: everything is warm after {time.monotonic() - self._began:.1f} s")
        except Exception:
            logger.exception("the warm-up failed")

    async def _load_all(self) -> None:
        for stage in STAGES:
            await self._load(stage)

    async def _compile(self) -> None:
        """Each track of stages in a process of its own as far as there are cores; each stage loaded when compiled."""
        cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
        tracks = TRACKS if cores > 1 else (STAGES,)
        async with asyncio.TaskGroup() as group:
            for track in tracks:
                group.create_task(self._compile_track(track))

    async def _compile_track(self, track: Sequence[Stage]) -> None:
        waiting = list(track)
        async with self._pool.compiler([stage.name for stage in track]) as lines:
            async for line in lines:
                if line.startswith(b"stage"):
                    self._keep(waiting[0])
                    await self._load(waiting.pop(0))
                else:
                    self._compiled[waiting[0].name] += 1
                    self._show()
        if waiting:
            logger.warning("compilation of %s ended early; the rest is compiled where it is needed", waiting[0].name)
        for stage in waiting:
            await self._load(stage)
            self._keep(stage)

    def _keep(self, stage: Stage) -> None:
        """Note that the stage is compiled and on disk, and when all are: a start that ends early loses nothing."""
        self._kept.add(stage)
        if len(self._kept) == len(STAGES):
            mark_complete(content())

    async def _load(self, stage: Stage) -> None:
        async with self._loading:
            await self._pool.warm(stage.name)
            self._warm.append(stage)
            self._pool.renew()
            self._show()

    def _share(self, stage: Stage) -> float:
        return 1.0 if stage in self._warm else min(0.99, self._compiled[stage.name] / max(1, stage.kernels))

    def _show(self) -> None:
        self._progress.show({stage.name: self._share(stage) for stage in STAGES})
