"""The template process and its copies: workers answer calls, compilers fill the kernel cache.

The template has one thread, so that no copy inherits a lock that is held, and freezes what it has loaded, so that the
garbage collector of a copy does not touch it and the memory stays shared. It carries out one command after the other,
each a name and an argument, and sends an answer to each:

    ("work", memory_mb), then a descriptor      a new worker that serves the descriptor: its process id
    ("compile", stages), then a descriptor      a process that compiles these stages: its process id
    ("reap", process id)                        wait until the process has ended; its id is free from then on
    ("warm", stage)                             load a stage: how many kernels had to be compiled for it
"""

import ctypes
import gc
import logging
import os
import pickle
import resource
import select
import signal
import sys
import threading
import traceback
from collections.abc import Callable, Sequence
from functools import partial
from importlib import import_module
from multiprocessing.connection import Connection
from multiprocessing.reduction import recv_handle
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from app.calculations import Stage

PR_SET_PDEATHSIG = 1  # linux/prctl.h
MEBIBYTE = 2**20  # bytes

logger = logging.getLogger("tribodrive")


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
