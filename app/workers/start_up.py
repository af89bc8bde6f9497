"""Start-up while the port is open: kernels are compiled in other processes and loaded stage by stage.

The endpoints of a stage answer as soon as it is loaded.
"""

import asyncio
import logging
import os
import sys
import time
from collections import Counter, deque
from collections.abc import Sequence
from contextlib import suppress

from app.calculations import BY_PATH, CALCULATIONS, Stage
from app.errors import WarmingUp
from app.workers.pool import Pool
from app.workers.processes import ProcessDied
from app.workers.stages import STAGES, TRACKS, content
from solvers.kernel_cache import discard, is_complete, mark_complete, writable_root

MOST_DEATHS = 3  # of the template over one stage
BAR = 40  # characters

logger = logging.getLogger("tribodrive")


class StartUp:
    """Loads the stages; those in `warm` answer."""

    def __init__(self, pool: Pool) -> None:
        self.warm: list[Stage] = []
        self._pool = pool
        self._compiled: Counter[Stage] = Counter()  # kernels so far
        self._missing = 0  # kernels that were not found on disk when they were loaded
        self._deaths: Counter[Stage] = Counter()  # of the template while it loaded a stage
        self._loading = asyncio.Lock()

    @property
    def complete(self) -> bool:
        """Whether every stage answers."""
        return len(self.warm) == len(STAGES)

    def report(self) -> str:
        """How far everything is, in words."""
        return ", ".join(f"{stage.name} {100 * self._share(stage):.0f} %" for stage in STAGES)

    def require(self, endpoint: str | None = None) -> None:
        """Raise WarmingUp if the endpoint's kernels are not there yet; without one, if no worker is there yet."""
        if not self.warm or (endpoint is not None and BY_PATH[endpoint].stage not in self.warm):
            raise self.warming_up()

    def warming_up(self) -> WarmingUp:
        """The error that says how far everything is."""
        return WarmingUp(f"Kernels are being compiled, once after installation: {self.report()}")

    def _share(self, stage: Stage) -> float:
        return 1.0 if stage in self.warm else min(0.99, self._compiled[stage] / max(1, stage.kernels))

    async def run(self) -> None:
        """Load every stage, and whenever the template is started again all of them again."""
        try:
            began = time.monotonic()
            await self._load_all()
            logger.info("tribodrive: everything is warm after %.1f s", time.monotonic() - began)
            while True:
                await self._pool.template_restarted.wait()
                await self._load(STAGES[-1])
        except Exception:
            logger.exception("the warm-up failed")

    async def _load_all(self) -> None:
        """Load every stage; compile beside the template what is not on disk, in two processes if there are two cores.

        The cache is marked as complete if loading found every kernel in it.
        """
        complete = is_complete(content())
        if complete or writable_root() is None:
            if not complete:
                logger.warning("no folder for compiled kernels can be written: they are compiled in memory")
            for stage in STAGES:
                await self._load(stage)
        else:
            async with asyncio.TaskGroup() as group:
                for track in TRACKS if len(os.sched_getaffinity(0)) > 1 else (STAGES,):
                    group.create_task(self._compile(track))
        if self._missing:
            logger.warning("%d kernels were not on disk; the next start compiles what is missing", self._missing)
        await asyncio.to_thread(mark_complete, content(), complete=not self._missing)

    async def _compile(self, stages: Sequence[Stage]) -> None:
        """Compile stages and load each when it is done; where the process is lost, loading compiles the rest."""
        waiting = deque(stages)
        with suppress(ProcessDied):
            async with self._pool.template.copy("compile", stages) as process:
                while waiting:
                    if await process.receive() is None:
                        self._compiled[waiting[0]] += 1
                        self._show()
                    else:
                        await self._load(waiting.popleft())
        for stage in waiting:
            logger.warning("%s is compiled by the template process: the one beside it was lost", stage.name)
            await self._load(stage)

    async def _load(self, stage: Stage) -> None:
        """Have the template load the stage, and what it had loaded before it was restarted; then open the stage."""
        async with self._loading:
            self._pool.template_restarted.clear()
            while missing := [
                each
                for each in (*self.warm, stage)
                if each not in self._pool.template.loaded and self._deaths[each] < MOST_DEATHS
            ]:
                try:
                    self._missing += await self._pool.template.warm(missing[0])
                    del self._deaths[missing[0]]
                except ProcessDied:
                    await self._pool.template_restarted.wait()
                    self._pool.template_restarted.clear()
                    self._count_death(missing[0])
            self._pool.renew()
            if stage not in self.warm:
                self.warm.append(stage)
                if not sys.stderr.isatty():
                    logger.info("tribodrive: %s is warm", stage.name)
            self._show()

    def _count_death(self, stage: Stage) -> None:
        """After the second death over a stage its kernels on disk may be damaged: loading it compiles them again."""
        self._deaths[stage] += 1
        if self._deaths[stage] == MOST_DEATHS:
            logger.error(
                "%s is not loaded: %d processes died while they loaded it; its first calls compile it",
                stage.name,
                MOST_DEATHS,
            )
        elif self._deaths[stage] > 1:
            logger.warning("two processes died while they loaded %s: its kernels are compiled again", stage.name)
            for calculation in CALCULATIONS:
                if calculation.stage == stage:
                    discard(calculation.solve.__module__)

    def _show(self) -> None:
        """Draw a progress bar over the one before, on a terminal."""
        if sys.stderr.isatty() and self._compiled:
            share = sum(self._share(stage) * stage.kernels for stage in STAGES) / sum(stage.kernels for stage in STAGES)
            at_work = ", ".join(stage.name for stage in STAGES if self._compiled[stage] and stage not in self.warm)
            above = "\x1b[A\x1b[2K" if self._compiled.total() > 1 else ""
            logger.info("%s%s %3.0f %% %s", above, f"{'█' * round(BAR * share):░<{BAR}}", 100 * share, at_work)
