"""Run a Dask cluster whose scheduler and workers are processes on this machine."""

import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from distributed import Client

from tests.support.server import ROOT, free_port

ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1"}
START_S = 60.0


@contextmanager
def _process(*arguments: str, root: Path = ROOT) -> Iterator[subprocess.Popen[bytes]]:
    process = subprocess.Popen(
        [sys.executable, "-m", *arguments],
        env={**os.environ, **ONE_THREAD, "PYTHONPATH": str(root)},
        cwd=root,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        yield process
    finally:
        process.terminate()
        with suppress(subprocess.TimeoutExpired):
            process.wait(10)
        process.kill()
        process.wait()


class DaskProcesses:
    """This object holds a Dask scheduler process, the address of the scheduler, and the worker processes."""

    def __init__(self, stack: ExitStack, protocol: str) -> None:
        port = free_port()
        self.address = f"{protocol}://127.0.0.1:{port}"
        self._stack = stack
        options = ("--host", f"{protocol}://127.0.0.1:{port}", "--no-dashboard", "--no-show")
        self.scheduler = stack.enter_context(_process("distributed.cli.dask_scheduler", *options))
        self.workers: list[subprocess.Popen[bytes]] = []

    def add_worker(self, root: Path = ROOT) -> None:
        """Start one more worker process, which has one thread and uses the sources in `root`.

        No nanny process restarts this worker.
        """
        options = ("--nthreads", "1", "--no-nanny", "--no-dashboard", "--host", "127.0.0.1", "--death-timeout", "60")
        self.workers.append(
            self._stack.enter_context(_process("distributed.cli.dask_worker", self.address, *options, root=root))
        )

    def wait(self) -> None:
        """Wait until every worker is connected to the scheduler. Raise RuntimeError if the cluster does not start."""
        end = time.monotonic() + START_S
        while True:
            with suppress(OSError, TimeoutError), Client(self.address, timeout=5, set_as_default=False) as client:
                client.wait_for_workers(len(self.workers), timeout=START_S)
                return
            if time.monotonic() > end:
                raise RuntimeError("the Dask cluster did not start")
            time.sleep(0.2)


@contextmanager
def running_cluster(workers: int, protocol: str = "tcp") -> Iterator[DaskProcesses]:
    """Start a scheduler and workers, each in a process of its own, and end the processes on exit."""
    with ExitStack() as stack:
        cluster = DaskProcesses(stack, protocol)
        for _ in range(workers):
            cluster.add_worker()
        cluster.wait()
        yield cluster
