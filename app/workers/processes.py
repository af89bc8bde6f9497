"""The template process, which loads everything once and is forked, and its copies: both ends of their connections.

`Template` and `Worker` are the ends in the service. The processes begin in `main`. The template has one thread, so that
no copy inherits a lock that is held, and freezes what it has loaded, so that the garbage collector of a copy does not
touch it and the memory stays shared. It carries out one command after the other, each a name and an argument, and sends
an answer to each:

    ("work", memory_mb), then a descriptor      a new worker that serves the descriptor: its process id
    ("compile", stages), then a descriptor      a process that compiles these stages: its process id
    ("reap", process id)                        wait until the process has ended; its id is free from then on
    ("warm", stage)                             load a stage: how many kernels had to be compiled for it
"""

import asyncio
import ctypes
import gc
import logging
import os
import pickle
import resource
import select
import signal
import socket
import struct
import subprocess
import sys
import threading
import traceback
from collections.abc import AsyncIterator, Callable, Sequence
from contextlib import asynccontextmanager, suppress
from functools import partial
from importlib import import_module
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from multiprocessing.reduction import recv_handle, send_handle
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from app.calculations import Stage

ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS", "MKL_NUM_THREADS"), "1")
ANSWER_S = 30.0  # a template that takes longer hangs: imports take seconds; only for loading a stage there is no limit
LENGTH = struct.Struct("!i")  # precedes each message of a multiprocessing.connection
PR_SET_PDEATHSIG = 1  # linux/prctl.h
MEBIBYTE = 2**20  # bytes

logger = logging.getLogger("tribodrive")


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
                    *(sys.executable, "-P", "-m", "app.workers.processes"),
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


def main(parent: int, descriptor: int, preloaded: str) -> None:
    """Import the module `preloaded`, then obey the commands that arrive on the descriptor until the parent ends."""
    if sys.platform == "linux":  # elsewhere the process ends when it next reads a command
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent:
        return
    gc.disable()  # imports leave no garbage, and looking for it takes a third of their time
    import_module(preloaded)  # so that no worker has to import what it is asked to call
    from app.workers import stages  # noqa: PLC0415

    gc.freeze()
    control = Connection(descriptor)
    while True:
        try:
            command = control.recv()
        except EOFError:
            return
        match command:
            case "work", memory_mb:
                answer = _copy(control, partial(_work, memory_mb=memory_mb))
            case "compile", some_stages:
                answer = _copy(control, partial(_compile, some_stages=some_stages))
            case "reap", pid:
                answer = os.waitpid(pid, 0)[0]
            case _, stage:
                answer = stages.warm(stage)  # where that fails this process ends: what it has loaded may be damaged
                gc.collect()
                gc.freeze()
        control.send(answer)


def _copy(control: Connection, serve: Callable[[Connection], None]) -> int:
    """The process id of a copy of this process that serves the descriptor which follows the command."""
    descriptor = recv_handle(control)
    if pid := os.fork():
        os.close(descriptor)
        return pid
    try:
        control.close()
        gc.enable()
        threading.Thread(target=_end_with_the_service, args=(descriptor,), daemon=True).start()
        serve(Connection(descriptor))
    except (EOFError, OSError):  # the service is gone
        pass
    except BaseException:
        logger.exception("a worker process failed")
    finally:
        os._exit(0)


def _end_with_the_service(descriptor: int) -> None:
    """End this process, whatever it does, when the other end of its connection is closed."""
    poll = select.poll()
    poll.register(descriptor, 0)  # nothing but the hang-up, which is always reported
    poll.poll()
    os._exit(1)


def _work(connection: Connection, memory_mb: int) -> None:
    """Answer calls: None when this process is ready and when a call begins, then the call's outcome."""
    from app.workers import stages  # noqa: PLC0415

    resource.setrlimit(resource.RLIMIT_DATA, (memory_mb * MEBIBYTE, memory_mb * MEBIBYTE))
    stages.touch_shared_memory()
    connection.send(None)
    while True:
        call = connection.recv_bytes()
        connection.send(None)
        connection.send_bytes(_outcome(call))


def _outcome(call: bytes) -> bytes:
    """The pickled pair of whether the call succeeded, and its result or its exception with the traceback as a note."""
    try:
        function, arguments = pickle.loads(call)  # noqa: S301  from the service itself
        return pickle.dumps((True, function(*arguments)))
    except Exception as error:  # noqa: BLE001  handed to the caller
        error.add_note(f"In the worker process:\n{traceback.format_exc()}")
        try:
            content = pickle.dumps((False, error))
            pickle.loads(content)  # noqa: S301
        except Exception:  # noqa: BLE001  not every exception can be pickled and read again
            return pickle.dumps((False, RuntimeError(traceback.format_exc())))
        return content


def _compile(connection: Connection, some_stages: "Sequence[Stage]") -> None:
    """Have the kernels of stages on disk: None is sent for every kernel, the stage when all of its kernels are there.

    What fails here fails once more, and is logged, when the template loads the stage.
    """
    from app.workers import stages  # noqa: PLC0415

    for stage in some_stages:
        stages.warm(stage, lambda: connection.send(None))
        connection.send(stage)


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3])
