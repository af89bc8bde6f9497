"""Start-up while workers answer: `tribodrive compile` runs beside them; endpoints open when their kernels are there."""

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

logger = logging.getLogger("tribodrive")


class StartUp:
    """Compiles the stages and lets their endpoints answer."""

    def __init__(self) -> None:
        self._percent = dict.fromkeys((stage.name for stage in STAGES), 0)

    @property
    def warm(self) -> list[str]:
        """Names of the stages that answer."""
        return [name for name, percent in self._percent.items() if percent == 100]

    def require(self, *endpoints: str) -> None:
        """Raise WarmingUp if kernels of one of the endpoints are not there yet, or no stage is ready."""
        if not {BY_PATH[endpoint].stage.name for endpoint in endpoints} <= {*self.warm} or not self.warm:
            raise self._warming_up()

    def require_all(self) -> None:
        """Raise WarmingUp if a stage is not ready."""
        if len(self.warm) < len(self._percent):
            raise self._warming_up()

    def _warming_up(self) -> WarmingUp:
        report = ", ".join(f"{name} {percent} %" for name, percent in self._percent.items())
        return WarmingUp(f"Kernels are being compiled, once after installation: {report}")

    async def run(self) -> None:
        """Open stage after stage."""
        began = time.monotonic()
        if FOLDER is not None and not await self._compile(STAGES):
            logger.warning("a process that compiled kernels died: all are compiled anew")
            await asyncio.to_thread(rmtree, FOLDER, ignore_errors=True)
            if not await self._compile(STAGES):
                logger.warning("it died again: kernels that are not on disk are compiled when they are needed")
        for stage in STAGES:
            self._advance(stage.name, 100)
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
                name, _, percent = line.decode().removesuffix(" %\n").partition(": ")
                self._advance(name, int(percent))
                if other is None and 0 < int(percent) < 100 and BESIDE in stages[1:] and (os.cpu_count() or 1) > 1:
                    other = asyncio.create_task(self._compile([BESIDE]))
                if other is not None and {stage.name for stage in stages} - {BESIDE.name} <= {*self.warm}:
                    return await other
            return await process.wait() in {0, 130}  # the second after Ctrl-C
        finally:
            if other is not None:
                other.cancel()
            with suppress(ProcessLookupError):
                process.kill()
            await process.wait()

    def _advance(self, name: str, percent: int) -> None:
        if percent == 100 > self._percent[name]:
            logger.info("tribodrive: %s is warm", name)
        self._percent[name] = max(percent, self._percent[name])
