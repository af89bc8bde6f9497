"""Start-up of the service: `tribodrive compile` runs beside the workers. Requests wait until their groups are ready."""

import asyncio
import logging
import os
import re
import signal
import sys
import time
from asyncio.subprocess import DEVNULL, PIPE
from collections.abc import Collection, Sequence
from contextlib import suppress
from shutil import rmtree

from fastapi import Request

from app.errors import WarmingUp
from app.models.kernels import KERNEL_GROUPS, LINE_CONTACT, KernelGroup
from app.workers.pool import Pool, unless_gone
from solvers.kernel_cache import FOLDER

BESIDE = LINE_CONTACT  # compiled beside the other groups, because it takes as long as all of them together
WAIT_S = 90.0  # longest time that a request waits for its kernels; the client itself waits for 120 s
STOPPED = {-signal.SIGTERM, -signal.SIGINT}  # exit codes of a compilation that was ended with the service
STOP_S = 5.0  # a signal to the group reaches the service within this time
PROGRESS = re.compile(rb"([a-z ]+): (\d+) %\n")

logger = logging.getLogger("tribodrive")


class StartUp:
    """The compilation of all groups, and the progress of the groups."""

    def __init__(self) -> None:
        self._percent = dict.fromkeys((group.name for group in KERNEL_GROUPS), 0)
        self._ready = {group.name: asyncio.Event() for group in KERNEL_GROUPS}

    @property
    def warm(self) -> list[str]:
        """Names of the groups that are ready."""
        return [name for name, percent in self._percent.items() if percent == 100]

    def require(self, groups: Collection[KernelGroup] | None = None) -> None:
        """Raise WarmingUp if one of the groups is not ready; None: any group."""
        if not {group.name for group in (KERNEL_GROUPS if groups is None else groups)} <= {*self.warm}:
            report = ", ".join(f"{name} {percent} %" for name, percent in self._percent.items())
            raise WarmingUp(f"The solvers are being compiled, which happens once after installation: {report}")

    async def wait(self, http: Request, groups: Collection[KernelGroup]) -> None:
        """Wait until the groups of a request are ready. Raises WarmingUp after `WAIT_S`, ClientGone if nobody waits."""
        names = {group.name for group in groups} - {*self.warm}
        if names:
            waiting = asyncio.gather(*(self._ready[name].wait() for name in names & self._ready.keys()))
            with suppress(TimeoutError):
                await unless_gone(http, waiting, lambda: WAIT_S)
            self.require(groups)

    async def run(self, pool: Pool) -> None:
        """Compile all groups. If a process fails, compile once more in an empty folder.

        If compiled kernels cannot be kept, the workers of `pool` compile them, so that the groups wait for a worker.
        """
        began = time.monotonic()
        if FOLDER is None:
            logger.warning(
                "tribodrive: compiled kernels cannot be kept; every worker compiles all of them at its start"
            )
            while pool.alive <= 0:  # noqa: ASYNC110  the pool counts its workers; nothing else waits for them
                await asyncio.sleep(1.0)
        elif not await self._compile(KERNEL_GROUPS):
            logger.warning("a process that compiled kernels died: all are compiled anew")
            await asyncio.to_thread(rmtree, FOLDER, ignore_errors=True)
            if not await self._compile(KERNEL_GROUPS):
                logger.warning("it died again: kernels that are not on disk are compiled when they are needed")
        for group in KERNEL_GROUPS:
            self._advance(group.name, 100)
        logger.info("tribodrive: everything is warm after %.1f s", time.monotonic() - began)

    async def _compile(self, groups: Sequence[KernelGroup]) -> bool:
        """Run `tribodrive compile` and read the printed progress. Return False if the process failed.

        If kernels have to be compiled, a second process compiles the group `BESIDE` on another processor.
        """
        other: asyncio.Task[bool] | None = None
        process = await asyncio.create_subprocess_exec(
            *(sys.executable, "-P", "-m", "app", "compile"),  # -P: ignore a folder `app` in the working directory
            *(group.name for group in groups),
            stdin=DEVNULL,
            stdout=PIPE,
            start_new_session=True,  # Ctrl-C ends the service only; Python would report a Ctrl-C during its own start
            env={**os.environ, "PYTHONPATH": os.pathsep.join(map(os.path.abspath, sys.path))},
        )
        try:
            assert process.stdout is not None
            async for line in process.stdout:
                if (progress := PROGRESS.fullmatch(line)) is None or progress[1].decode() not in self._percent:
                    logger.warning(
                        "a process that compiles kernels said: %s", line[:200].decode(errors="replace").strip()
                    )
                    continue
                name, percent = progress[1].decode(), int(progress[2])
                self._advance(name, percent)
                if other is None and 0 < percent < 100 and BESIDE in groups[1:] and (os.cpu_count() or 1) > 1:
                    other = asyncio.create_task(self._compile([BESIDE]))
                if other is not None and {group.name for group in groups} - {BESIDE.name} <= {*self.warm}:
                    return await other
            code = await process.wait()
            if code in STOPPED:  # the service itself is about to be ended; what is compiled stays
                await asyncio.sleep(STOP_S)
            return code == 0
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
        if percent == 100:
            self._ready[name].set()
