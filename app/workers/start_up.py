"""Start-up while the workers answer: kernels are compiled by `tribodrive compile` in other processes.

The endpoints of a stage open as soon as its kernels are on disk.
"""

import asyncio
import logging
import os
import sys
import time
from asyncio.subprocess import DEVNULL, PIPE
from collections.abc import Sequence
from contextlib import suppress
from shutil import rmtree

from app.calculations import BY_PATH, Stage
from app.errors import WarmingUp
from app.workers.stages import BESIDE, STAGES
from solvers.kernel_cache import FOLDER

INTERRUPTED = 130  # exit status after Ctrl-C

logger = logging.getLogger("tribodrive")


class StartUp:
    """Compiles the stages; those in `warm` answer."""

    def __init__(self) -> None:
        self.warm: list[Stage] = []
        self._percent = dict.fromkeys((stage.name for stage in STAGES), 0)

    @property
    def complete(self) -> bool:
        """Whether every stage answers."""
        return len(self.warm) == len(STAGES)

    def report(self) -> str:
        """Say how far everything is."""
        return ", ".join(f"{name} {percent} %" for name, percent in self._percent.items())

    def require(self, endpoint: str | None = None) -> None:
        """Raise WarmingUp if the endpoint's kernels are not there yet; if None, only if no stage is ready."""
        if not self.warm or (endpoint is not None and BY_PATH[endpoint].stage not in self.warm):
            raise WarmingUp(f"Kernels are being compiled, once after installation: {self.report()}")

    async def run(self) -> None:
        """Open stage after stage."""
        began = time.monotonic()
        if FOLDER is not None and not await self._compile(STAGES):
            logger.warning("a process that compiled kernels died: all are compiled anew")
            await asyncio.to_thread(rmtree, FOLDER, ignore_errors=True)
            if not await self._compile(STAGES):
                logger.warning("it died again: kernels that are not on disk are compiled when they are needed")
        for stage in STAGES:
            self._open(stage.name)
        logger.info("tribodrive: everything is warm after %.1f s", time.monotonic() - began)

    async def _compile(self, stages: Sequence[Stage]) -> bool:
        """Follow the lines that `tribodrive compile` prints; False if its process died.

        As soon as a kernel has to be compiled, another process compiles the stage `BESIDE` the others.
        """
        other: asyncio.Task[bool] | None = None
        process = await asyncio.create_subprocess_exec(
            *(sys.executable, "-P", "-m", "app", "compile"),  # -P: a folder `app` in the working directory is not ours
            *(stage.name for stage in stages),
            stdin=DEVNULL,
            stdout=PIPE,
            env={**os.environ, "PYTHONPATH": os.pathsep.join(map(os.path.abspath, sys.path))},
        )
        try:
            assert process.stdout is not None
            async for line in process.stdout:
                name, _, percent = line.decode().partition(": ")
                self._percent[name] = int(percent.removesuffix(" %\n"))
                if self._percent[name] == 100:
                    self._open(name)
                elif self._percent[name] and other is None and BESIDE in stages[1:] and (os.cpu_count() or 1) > 1:
                    other = asyncio.create_task(self._compile([BESIDE]))
                if other is not None and {*stages} - {BESIDE} <= {*self.warm}:
                    return await other
            return await process.wait() in {0, INTERRUPTED}
        finally:
            if other is not None:
                other.cancel()
            with suppress(ProcessLookupError):
                process.kill()
            await process.wait()

    def _open(self, name: str) -> None:
        """Let the endpoints of a stage answer."""
        stage = next(stage for stage in STAGES if stage.name == name)
        if stage not in self.warm:
            self._percent[name] = 100
            self.warm.append(stage)
            logger.info("tribodrive: %s is warm", name)
