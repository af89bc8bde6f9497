"""The template process and its copies as objects of the service: commands, calls and their results."""

import asyncio
import os
import pickle
import signal
import socket
import struct
import subprocess
import sys
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, suppress
from multiprocessing import Pipe
from multiprocessing.reduction import send_handle
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from app.calculations import Stage

ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS", "MKL_NUM_THREADS"), "1")
ANSWER_S = 30.0  # a template that takes longer hangs: imports take seconds; only for loading a stage there is no limit
LENGTH = struct.Struct("!i")  # precedes each message of a multiprocessing.connection


class ProcessDied(Exception):
    """The process ended, or was ended, before its message arrived."""


class Worker:
    """A process forked from the template: carries out one call at a time, or compiles stages.

    Its messages are read in the event loop, because a thread per worker answers a third fewer calls per second. `begun`
    is True once the process carries out the last call; `outdated` is True if the template has loaded more stages since
    this process was forked.
    """

    def __init__(self, pid: int, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self.pid = pid
        self.begun = self.outdated = False
        self.ended = asyncio.Event()
        self._reader = reader
        self._writer = writer

    async def call(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """What the function returns or raises in the process; ProcessDied if that ends first.

        Without an outcome the process is ended: its next message would be taken for the answer to the next call.
        """
        content = pickle.dumps((function, arguments))
        self.begun = False
        try:
            self._writer.write(LENGTH.pack(len(content)) + content)
            await self.receive()
            self.begun = True
            succeeded, result = await self.receive()
        except BaseException:
            self.end()
            raise
        if succeeded:
            return result
        raise result

    async def receive(self) -> Any:
        """The next message of the process; raises ProcessDied at its end."""
        try:
            (size,) = LENGTH.unpack(await self._reader.readexactly(LENGTH.size))
            return pickle.loads(await self._reader.readexactly(size))  # noqa: S301  from a process of ours
        except (OSError, EOFError) as error:
            raise ProcessDied from error

    def end(self) -> None:
        """Kill the process, whatever it does."""
        if not self.ended.is_set():
            self.ended.set()
            with suppress(ProcessLookupError):
                os.kill(self.pid, signal.SIGKILL)  # not reaped yet: still this process and no other
            self._writer.transport.abort()


class Template:
    """A running template process that has imported the module `preloaded`, and with it all that workers call."""

    def __init__(self, preloaded: str) -> None:
        self.preloaded = preloaded
        self.loaded: set[Stage] = set()
        self._turn = asyncio.Lock()  # one command at a time
        self._control, theirs = Pipe()
        with theirs:
            self._process = subprocess.Popen(  # noqa: S603
                # -P: a folder `app` in the working directory is not ours.
                [
                    *(sys.executable, "-P", "-m", "app.workers.template"),
                    *(str(os.getpid()), str(theirs.fileno()), preloaded),
                ],
                stdin=subprocess.DEVNULL,
                pass_fds=[theirs.fileno()],
                process_group=0,  # a terminal's Ctrl-C is for the service to act on
                env={**os.environ, **ONE_THREAD, "PYTHONPATH": os.pathsep.join(map(os.path.abspath, sys.path))},
            )

    @property
    def lost(self) -> bool:
        """Whether it died or was stopped."""
        return self._process.poll() is not None or not is_running(self._process.pid)

    @asynccontextmanager
    async def copy(self, purpose: str, argument: Any) -> AsyncIterator[Worker]:
        """A copy of the process, which is ended when the context is left; raises ProcessDied.

        To "work" with so many MiB of memory it sends a message when it is ready. To "compile" a sequence of stages it
        sends None for each kernel, and the stage when that is compiled.
        """
        ours, theirs = socket.socketpair()
        with theirs:
            pid = await self._ask(purpose, argument, descriptor=theirs.fileno())
        worker = Worker(pid, *await asyncio.open_unix_connection(sock=ours))
        try:
            yield worker
        finally:
            worker.end()
            with suppress(ProcessDied):
                await self._ask("reap", pid)

    async def warm(self, stage: "Stage") -> int:
        """Load a stage; how many kernels had to be compiled for it. Raises ProcessDied."""
        compiled = await self._ask("warm", stage)
        self.loaded.add(stage)
        return compiled

    def close(self) -> None:
        """End the process."""
        self._process.kill()
        self._process.wait()

    async def _ask(self, *command: Any, descriptor: int | None = None) -> int:
        """The template's answer to a command, waited for in a thread; raises ProcessDied where it dies or hangs."""
        async with self._turn:
            try:
                self._control.send(command)
                if descriptor is not None:
                    send_handle(self._control, descriptor, self._process.pid)
                async with asyncio.timeout(None if command[0] == "warm" else ANSWER_S):
                    return await asyncio.to_thread(self._control.recv)
            except BaseException as error:
                self._process.kill()  # the answer to this command must not be taken for that to the next
                if isinstance(error, (OSError, EOFError)):
                    raise ProcessDied from error
                raise


def is_running(pid: int) -> bool:
    """Whether a process is neither dead nor stopped, as far as the system says."""
    try:
        status = Path(f"/proc/{pid}/stat").read_bytes()
    except OSError:
        return not Path("/proc/self/stat").exists()
    return status.rpartition(b") ")[2][:1] not in {b"T", b"t", b"Z", b"X"}
