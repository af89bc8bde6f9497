"""The template process and its copies as objects of the service: commands, calls and their results."""

import asyncio
import os
import pickle
import signal
import socket
import struct
import subprocess
import sys
from collections.abc import AsyncIterator, Callable, Sequence
from contextlib import asynccontextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from app.calculations import Stage

ANSWER_S = 10.0  # a template that takes longer is replaced; loading a stage may take as long as it takes
ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS", "MKL_NUM_THREADS"), "1")
LENGTH = struct.Struct("!i")  # precedes each message of a multiprocessing.connection


class ProcessDied(Exception):
    """The process ended, or was ended, before its message arrived."""


class Worker:
    """A copy of the template: makes one call at a time, or compiles stages.

    The event loop reads its connection: a thread for each worker would answer a third fewer calls per second. `busy`
    says that the outcome of a call is outstanding, `begun` that the process has begun to carry it out, `outdated` that
    the template has loaded more since.
    """

    def __init__(self, pid: int, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self.pid = pid
        self.busy = self.begun = self.outdated = False
        self.ended = asyncio.Event()
        self._reader = reader
        self._writer = writer

    async def call(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """What the function returns or raises in the process; ProcessDied if that ends first."""
        content = pickle.dumps((function, arguments), pickle.HIGHEST_PROTOCOL)
        self.busy, self.begun = True, False
        self._writer.write(LENGTH.pack(len(content)) + content)
        await self.receive()
        self.begun = True
        succeeded, result = await self.receive()
        self.busy = False
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
        self._ready = False
        self._turn = asyncio.Lock()  # one command at a time
        self._control, theirs = socket.socketpair()
        self._control.setblocking(False)
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

    async def fork(self, memory_mb: int) -> Worker:
        """A new worker, which sends a message when it is ready."""
        return await self._copy("fork", memory_mb)

    @asynccontextmanager
    async def compiler(self, stages: "Sequence[Stage]") -> AsyncIterator[Worker]:
        """A process that compiles these stages; it sends None for each kernel and a stage when that is compiled."""
        process = await self._copy("compile", tuple(stages))
        try:
            yield process
        finally:
            process.end()
            await self.reap(process)

    async def warm(self, stage: "Stage") -> int:
        """Load a stage, unless it is; how many kernels had to be compiled for it."""
        if stage in self.loaded:
            return 0
        compiled = await self._ask("warm", stage, seconds=None)
        self.loaded.add(stage)
        return compiled

    async def reap(self, worker: Worker) -> None:
        """Free the process id of a worker that was ended."""
        with suppress(ProcessDied):
            await self._ask("reap", worker.pid)

    def close(self) -> None:
        """End the process; the connection is closed with this object, for a command may still wait for an answer."""
        self._process.kill()
        self._process.wait()

    async def _copy(self, name: str, argument: Any) -> Worker:
        ours, theirs = socket.socketpair()
        with theirs:
            pid = await self._ask(name, argument, theirs.fileno())
        return Worker(pid, *await asyncio.open_unix_connection(sock=ours))

    async def _ask(self, name: str, argument: Any, *descriptors: int, seconds: float | None = ANSWER_S) -> int:
        """The template's answer to a command; raises ProcessDied."""
        async with self._turn:
            try:
                if not self._ready:  # its imports take seconds
                    await self._answer()
                    self._ready = True
                async with asyncio.timeout(seconds):
                    socket.send_fds(self._control, [pickle.dumps((name, argument))], descriptors)
                    return await self._answer()
            except BaseException as error:
                self._process.kill()  # the answer to this command must not be taken for that to the next
                if isinstance(error, (OSError, EOFError)):
                    raise ProcessDied from error
                raise

    async def _answer(self) -> int:
        answer: int = pickle.loads(await asyncio.get_running_loop().sock_recv(self._control, 64))  # noqa: S301
        return answer


def is_running(pid: int) -> bool:
    """Whether a process is neither dead nor stopped, as far as the system says."""
    try:
        status = Path(f"/proc/{pid}/stat").read_bytes()
    except OSError:
        return not Path("/proc/self/stat").exists()
    return status.rpartition(b") ")[2][:1] not in {b"T", b"t", b"Z", b"X"}
