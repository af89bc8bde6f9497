"""Start-up of the service: `tribodrive compile` runs beside the workers. Endpoints open when their stage is ready."""

import asyncio
import logging
import os
import sys
import time
from asyncio.subprocess import DEVNULL, PIPE
from collections.abc import Sequence
from contextlib import suppress
from shutil import rmtree

from app.calculations import BY_PATH, LINE_CONTACT, STAGES, Stage
from app.errors import WarmingUp
from solvers.kernel_cache import FOLDER

BESIDE = LINE_CONTACT  # compiled beside the other stages, because it takes as long as all of them together

logger = logging.getLogger("tribodrive")


class StartUp:
    """The compilation of all stages, and the progress of the stages."""

    def __init__(self) -> None:
        self._percent = dict.fromkeys((stage.name for stage in STAGES), 0)

    @property
    def warm(self) -> list[str]:
        """Names of the stages that are ready."""
        return [name for name, percent in self._percent.items() if percent == 100]

    def require(self, *endpoints: str) -> None:
        """Raise WarmingUp if the stage of an endpoint is not ready. If none is given, check all stages."""
        needed = {BY_PATH[endpoint].stage.name for endpoint in endpoints} or {*self._percent}
        if not needed <= {*self.warm}:
            report = ", ".join(f"{name} {percent} %" for name, percent in self._percent.items())
            raise WarmingUp(f"The solvers are being compiled, which happens once after installation: {report}")

    async def run(self) -> None:
        """Compile all stages, then open all endpoints. If a process fails, compile once more in an empty folder."""
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
        """Run `tribodrive compile` and read the printed progress. Return False if the process failed.

        If kernels have to be compiled, a second process compiles the stage `BESIDE` on another processor.
        """
        other: asyncio.Task[bool] | None = None
        process = await asyncio.create_subprocess_exec(
            *(sys.executable, "-P", "-m", "app", "compile"),  # -P: ignore a folder `app` in the working directory
            *(stage.name for stage in stages),
            stdin=DEVNULL,
            stdout=PIPE,
            start_new_session=True,  # Ctrl-C ends the service only; Python would report a Ctrl-C during its own start
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
            return await process.wait() == 0
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
