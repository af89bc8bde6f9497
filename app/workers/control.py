"""The service's end of the template process and its copies."""

import asyncio
import os
import pickle
import signal
import socket
import struct
import subprocess
import sys
from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from multiprocessing import Pipe
from multiprocessing.reduction import send_handle
from pathlib import Path
from typing import Any, TypeVar

# A template that takes longer is replaced. Loading a stage may take as long as it takes.
ANSWER_S = {"fork": 10.0, "compile": 10.0, "reap": 10.0}
LOOK_S = 0.1  # how often a process that starts is looked at
ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS", "MKL_NUM_THREADS"), "1")
T = TypeVar("T")
LENGTH = struct.Struct("!i")  # stands before each message of a multiprocessing.connection


class WorkerDied(Exception):
    """The process ended, or was ended, before its message arrived."""


class TemplateLost(Exception):
    """The template process died or does not answer."""


class Worker:
    """A copy of the template: makes one call at a time, or compiles and says how far it is.

    Its connection is read by the event loop: one thread for each worker answers a third fewer calls per second.
    """

    def __init__(
        self, template: "Template", pid: int, reader: asyncio.StreamReader, writer: asyncio.StreamWriter
    ) -> None:
        self.pid = pid
        self.alive = True
        self.busy = False
        self.begun = False  # whether the process has begun with the call
        self._template = template
        self._reader = reader
        self._writer = writer

    async def call(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """What the function returns or raises in the process; WorkerDied if that ends first."""
        content = pickle.dumps((function, arguments), pickle.HIGHEST_PROTOCOL)
        self.busy, self.begun = True, False
        self._writer.write(LENGTH.pack(len(content)) + content)
        await self.receive()
        self.begun = True
        outcome = await self.receive()
        self.busy = False
        succeeded, result = pickle.loads(outcome)  # noqa: S301  from a process of ours
        if succeeded:
            return result
        raise result

    async def receive(self) -> bytes:
        """The next message of the process; raises WorkerDied at its end."""
        try:
            (size,) = LENGTH.unpack(await self._reader.readexactly(LENGTH.size))
            return await self._reader.readexactly(size)
        except (OSError, EOFError) as error:
            raise WorkerDied from error

    def end(self) -> None:
        """Kill the process, whatever it does."""
        if self.alive:
            self.alive = False
            with suppress(ProcessLookupError):
                os.kill(self.pid, signal.SIGKILL)  # not reaped yet: still this process and no other
            self._writer.transport.abort()
            self._template.reap(self.pid)


class Template:
    """A running template process that has imported the module `preloaded`, and with it all that workers call."""

    def __init__(self, preloaded: str) -> None:
        self.preloaded = preloaded
        self.loaded: set[str] = set()
        self._ready = False
        self._thread = ThreadPoolExecutor(1, "template")  # one command at a time
        self._control, theirs = Pipe()
        with theirs:
            descriptor = theirs.fileno()
            self._process = subprocess.Popen(  # noqa: S603
                # -P: a folder `app` in the working directory is not ours.
                [sys.executable, "-P", "-m", "app.workers.template", str(os.getpid()), str(descriptor), preloaded],
                stdin=subprocess.DEVNULL,
                pass_fds=[descriptor],
                process_group=0,  # a terminal's Ctrl-C is for the service to act on
                env={**os.environ, **ONE_THREAD, "PYTHONPATH": os.pathsep.join(map(os.path.abspath, sys.path))},
            )

    @property
    def lost(self) -> bool:
        """Whether it died or was stopped."""
        return self._process.poll() is not None or not is_running(self._process.pid)

    async def fork(self, memory_mb: int) -> Worker:
        """A new worker, ready to be called; raises TemplateLost and WorkerDied."""
        worker = await self._copy("fork", memory_mb)
        ready = asyncio.ensure_future(worker.receive())
        try:
            while not (await asyncio.wait({ready}, timeout=LOOK_S))[0]:
                if not is_running(worker.pid):  # stopped before anybody else watches it
                    worker.end()
            ready.result()
        except BaseException:
            ready.cancel()
            worker.end()
            raise
        return worker

    async def compile(self, stages: Sequence[str]) -> Worker:
        """A new process that compiles these stages and sends a message for every kernel and every stage."""
        return await self._copy("compile", tuple(stages))

    async def warm(self, stage: str) -> int:
        """Load a stage, unless it is; how many kernels had to be compiled for it."""
        if stage in self.loaded:
            return 0
        compiled: int = await asyncio.wrap_future(self._submit(self._exchange, "warm", stage))
        self.loaded.add(stage)
        return compiled

    def reap(self, pid: int) -> None:
        """Have the template forget a process that was ended."""
        with suppress(TemplateLost):
            self._submit(self._exchange, "reap", pid)

    def close(self) -> None:
        """End the process; commands that it has not answered raise TemplateLost."""
        self._process.kill()
        self._process.wait()
        with suppress(TemplateLost):  # closed before
            self._submit(self._control.close)
        self._thread.shutdown(wait=False)

    async def _copy(self, name: str, argument: Any) -> Worker:
        pid, connection = await asyncio.wrap_future(self._submit(self._copied, name, argument))
        return Worker(self, pid, *await asyncio.open_unix_connection(sock=connection))

    def _copied(self, name: str, argument: Any) -> tuple[int, socket.socket]:
        """Process id and connection of a new copy of the template. Blocks."""
        ours, theirs = socket.socketpair()
        with theirs:
            return self._exchange(name, argument, theirs.fileno()), ours

    def _submit(self, function: Callable[..., T], *arguments: Any) -> Future[T]:
        try:
            return self._thread.submit(function, *arguments)
        except RuntimeError as error:
            raise TemplateLost from error

    def _exchange(self, name: str, argument: Any, descriptor: int | None = None) -> int:
        """The template's answer to a command. Blocks; raises TemplateLost."""
        try:
            if not self._ready:  # its imports take seconds
                self._ready = bool(self._control.recv())
            self._control.send((name, argument))
            if descriptor is not None:
                send_handle(self._control, descriptor, self._process.pid)
            if not self._control.poll(ANSWER_S.get(name)):
                self._process.kill()
            answer: int = self._control.recv()
        except (OSError, EOFError) as error:
            raise TemplateLost from error
        return answer


def is_running(pid: int) -> bool:
    """Whether a process is neither dead nor stopped, as far as the system says."""
    try:
        status = Path(f"/proc/{pid}/stat").read_bytes()
    except OSError:
        return not Path("/proc/self/stat").exists()
    return status.rpartition(b") ")[2][:1] not in {b"T", b"t", b"Z", b"X"}
