"""From an empty cache to everything warm while the port is open: compile beside, load, open stage after stage."""

import asyncio
import contextlib
import logging
import os
import time
from collections import Counter
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager

from app.calculations import Stage
from app.errors import WarmingUp
from app.workers.control import TemplateLost, WorkerDied
from app.workers.pool import Pool
from app.workers.progress import Progress
from app.workers.stages import STAGES, TRACKS, content, discard_kernels, needed_for
from solvers.kernel_cache import is_complete, mark_complete, writable_root

RETRY_S = 0.25

logger = logging.getLogger("tribodrive")


class StartUp:
    """What is warm, what is not, and the work that changes it."""

    def __init__(self, pool: Pool) -> None:
        self._pool = pool
        self._compiled: Counter[Stage] = Counter()
        self._missing = 0  # kernels that were not found on disk after their stage was compiled
        self._deaths: Counter[Stage] = Counter()  # of the template while it loaded a stage
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
            if writable_root() is None and not is_complete(content()):
                logger.warning("no folder for compiled kernels can be written: they are compiled in memory")
            if is_complete(content()) or writable_root() is None:
                for stage in STAGES:
                    await self._load(stage)
            else:
                await self._compile()
            self._progress.finish(f"tribodrive: everything is warm after {time.monotonic() - self._began:.1f} s")
            while True:
                await self._pool.template_restarted.wait()
                await self._load(STAGES[-1])
        except Exception:
            logger.exception("the warm-up failed")

    async def _compile(self) -> None:
        """Each track of stages in a process of its own as far as there are cores; each stage loaded when compiled."""
        cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
        async with asyncio.TaskGroup() as group:
            for track in TRACKS if cores > 1 else (STAGES,):
                group.create_task(self._compile_track(track))
        if self._missing:
            logger.warning("%d kernels could not be kept on disk; the next start compiles them again", self._missing)
        else:
            mark_complete(content())

    async def _compile_track(self, track: Sequence[Stage]) -> None:
        """Compile stages and load each when it is done; where the process is lost, loading compiles the rest."""
        waiting = list(track)
        with contextlib.suppress(TemplateLost, WorkerDied):
            async with self._pool.compiler([stage.name for stage in track]) as process:
                while waiting:
                    if await process.receive() == b"stage":
                        await self._load(waiting.pop(0))
                    else:
                        self._compiled[waiting[0]] += 1
                        self._show()
        for stage in waiting:
            logger.warning("%s is compiled by the template process: the one beside it was lost", stage.name)
            await self._load(stage)

    async def _load(self, stage: Stage) -> None:
        """Have the template load the stage, and what it had loaded before it was restarted; then open the stage."""
        async with self._loading:
            while True:
                self._pool.template_restarted.clear()
                try:
                    for each in dict.fromkeys((*self._warm, stage)):
                        loading = each
                        self._missing += await self._pool.warm(each.name)
                    break
                except TemplateLost:
                    await self._mend(loading)
            if stage not in self._warm:
                self._warm.append(stage)
            self._pool.renew()
            self._show()

    async def _mend(self, stage: Stage) -> None:
        """Wait for another template; where a second one died over a stage, its kernels on disk are not sound."""
        self._deaths[stage] += 1
        await asyncio.sleep(RETRY_S)
        if self._deaths[stage] == 2:
            logger.warning("two processes died while they loaded %s: its kernels are compiled again", stage.name)
            discard_kernels(stage)
            with contextlib.suppress(TemplateLost, WorkerDied):
                async with self._pool.compiler([stage.name]) as process:
                    while await process.receive() != b"stage":
                        pass

    def _share(self, stage: Stage) -> float:
        return 1.0 if stage in self._warm else min(0.99, self._compiled[stage] / max(1, stage.kernels))

    def _show(self) -> None:
        self._progress.show({stage.name: self._share(stage) for stage in STAGES})
