"""The service's end of the template process: starts it, has it fork workers, replaces it when it fails."""

import asyncio
import contextlib
import os
import pickle
import signal
import socket
import subprocess
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, cast

from app.processes import child_command, is_stopped
from app.workers.worker import LENGTH, framed

FORK_TIMEOUT_S = 10.0
ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS", "MKL_NUM_THREADS")


class WorkerDied(Exception):
    """The process ended, or was ended, before its outcome arrived."""


class TemplateLost(Exception):
    """The template process died or does not answer."""


class Worker(asyncio.Protocol):
    """One worker process: makes one call at a time."""

    def __init__(self, server: "ForkServer", pid: int, ended: Callable[["Worker"], None]) -> None:
        self.server = server
        self.pid = pid
        self.alive = True
        self._ended = ended
        self._outcome: asyncio.Future[bytes] | None = None
        self._received = bytearray()
        self._transport: asyncio.Transport

    async def call(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """What the function returns or raises in the process; WorkerDied if that ends first."""
        if not self.alive:
            raise WorkerDied
        self._outcome = asyncio.get_running_loop().create_future()
        self._transport.write(framed(pickle.dumps((function, arguments), pickle.HIGHEST_PROTOCOL)))
        try:
            succeeded, result = pickle.loads(await self._outcome)  # noqa: S301  from a process of ours
        finally:
            self._outcome = None
        if succeeded:
            return result
        raise result

    def kill(self) -> None:
        """End the process; `ended` follows."""
        if self.alive:
            with contextlib.suppress(ProcessLookupError):
                os.kill(self.pid, signal.SIGKILL)
            self._transport.abort()

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """The process listens."""
        self._transport = cast("asyncio.Transport", transport)

    def data_received(self, data: bytes) -> None:
        """A piece of an outcome."""
        self._received += data
        if len(self._received) < LENGTH.size:
            return
        size = LENGTH.size + LENGTH.unpack_from(self._received)[0]
        if len(self._received) >= size:
            content = bytes(self._received[LENGTH.size : size])
            self._received.clear()
            if self._outcome is not None and not self._outcome.done():
                self._outcome.set_result(content)

    def connection_lost(self, _exc: Exception | None) -> None:
        """The process ended, or its socket was closed."""
        self.alive = False
        if self._outcome is not None and not self._outcome.done():
            self._outcome.set_exception(WorkerDied())
        with contextlib.suppress(ProcessLookupError):
            os.kill(self.pid, signal.SIGKILL)  # not reaped yet: still this process and no other
        self._ended(self)


@dataclass(frozen=True, slots=True)
class Compiler:
    """One process that compiles: it says so line by line, and ends."""

    server: "ForkServer"
    pid: int
    lines: asyncio.StreamReader
    connection: asyncio.StreamWriter

    def end(self) -> None:
        """End the process, wherever it is."""
        with contextlib.suppress(ProcessLookupError):
            os.kill(self.pid, signal.SIGKILL)  # not reaped yet: still this process and no other
        self.connection.close()


class ForkServer:
    """A running template process."""

    def __init__(self, process: subprocess.Popen[bytes], control: socket.socket) -> None:
        self._process = process
        self._control = control
        self._lock = asyncio.Lock()
        self._ready = False

    @classmethod
    def start(cls) -> "ForkServer":
        """Start the process; it answers once it has imported what it needs."""
        ours, theirs = socket.socketpair()
        ours.setblocking(False)
        environment = {**os.environ, **dict.fromkeys(ONE_THREAD, "1")}
        with theirs:
            command = child_command("app.workers.template")
            process = subprocess.Popen(command, stdin=theirs.fileno(), env=environment)  # noqa: S603
        return cls(process, ours)

    @property
    def lost(self) -> bool:
        """Whether it died or was stopped."""
        return self._process.poll() is not None or is_stopped(self._process.pid)

    async def fork(self, memory_mb: int, ended: Callable[[Worker], None]) -> Worker:
        """A new worker process."""
        pid, ours = await self._copy(f"fork {memory_mb}")
        loop = asyncio.get_running_loop()
        _, worker = await loop.create_unix_connection(lambda: Worker(self, pid, ended), sock=ours)
        return worker

    async def compile(self, stages: Sequence[str]) -> Compiler:
        """A new process that compiles the kernels of these stages."""
        pid, ours = await self._copy(f"compile {','.join(stages)}")
        return Compiler(self, pid, *await asyncio.open_unix_connection(sock=ours))

    async def reap(self, pid: int) -> None:
        """Forget a process that was ended."""
        await self._command(f"reap {pid}", None, FORK_TIMEOUT_S)

    async def warm(self, stage: str) -> None:
        """Load what this stage needs."""
        await self._command(f"warm {stage}", None, None)

    def close(self) -> None:
        """End the process; commands it has not answered raise TemplateLost."""
        self._process.kill()
        self._process.wait()
        with contextlib.suppress(OSError):
            self._control.shutdown(socket.SHUT_RDWR)  # closed, it would leave those who wait for an answer waiting
        if not self._lock.locked():
            self._control.close()

    async def _copy(self, command: str) -> tuple[int, socket.socket]:
        """A copy of the process that obeys the command, and the socket it serves."""
        ours, theirs = socket.socketpair()
        with theirs:
            try:
                return int(await self._command(command, theirs, FORK_TIMEOUT_S)), ours
            except BaseException:
                ours.close()
                raise

    async def _command(self, command: str, descriptor: socket.socket | None, timeout_s: float | None) -> str:
        """The template's answer; a command once sent is waited for even if the caller has left."""
        return await asyncio.shield(asyncio.ensure_future(self._exchange(command, descriptor, timeout_s)))

    async def _exchange(self, command: str, descriptor: socket.socket | None, timeout_s: float | None) -> str:
        passed = os.dup(descriptor.fileno()) if descriptor else None
        try:
            async with self._lock:
                if not self._ready:  # however long its imports take on a busy machine
                    self._ready = bool(await self._answer())
                async with asyncio.timeout(timeout_s):
                    socket.send_fds(self._control, [command.encode()], [passed] if passed is not None else [])
                    answer = await self._answer()
        except (OSError, TimeoutError, ValueError) as error:
            self._process.kill()
            raise TemplateLost from error
        finally:
            if passed is not None:
                os.close(passed)
            if self._process.returncode is not None:
                self._control.close()
        if not answer:
            raise TemplateLost
        return answer.decode().strip()

    async def _answer(self) -> bytes:
        """The next line; nothing once the process is gone."""
        return await asyncio.get_running_loop().sock_recv(self._control, 64)
