"""The template process and its copies: workers answer calls, compilers fill the kernel cache.

The template has one thread, so that no copy inherits a lock that is held, and freezes what it has loaded, so that the
garbage collector of a copy does not touch it and the memory stays shared. It obeys one command at a time:

    ("fork", memory_mb), then a descriptor      a new worker that serves the descriptor; answers its process id
    ("compile", stage names), then a descriptor a process that compiles these stages; answers its process id
    ("reap", process id)                        the process has ended; its id is free from now on
    ("warm", stage name)                        load a stage; answers how many kernels had to be compiled for it
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
from typing import Any

PR_SET_PDEATHSIG = 1
MEBIBYTE = 2**20

logger = logging.getLogger("tribodrive")


def main(parent: int, descriptor: int, preloaded: str) -> None:
    """Import the module `preloaded`, then obey the commands that arrive on the descriptor until the parent ends."""
    if sys.platform == "linux":  # elsewhere the process ends when it next reads a command
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent:
        return
    gc.disable()  # imports leave no garbage, and looking for it takes a third of their time
    import_module(preloaded)  # so that no worker has to import what it is asked to call
    gc.freeze()
    with Connection(descriptor) as control:
        control.send("ready")
        while True:
            try:
                command = control.recv()
            except EOFError:
                return
            control.send(_obey(control, *command))


def _obey(control: Connection, name: str, argument: Any) -> int:
    match name:
        case "fork":
            return _copy(control, partial(_work, memory_mb=argument))
        case "compile":
            return _copy(control, partial(_compile, names=argument))
        case "reap":
            return os.waitpid(argument, 0)[0]
        case _:
            return _warm(argument)


def _warm(name: str) -> int:
    """Load a stage; one that fails is logged, and costs its first callers time."""
    from app.workers import stages  # noqa: PLC0415  numba, which the service's own process does without

    try:
        return stages.warm(stages.stage_of(name))
    except Exception:
        logger.exception("%s failed while its kernels were loaded", name)
        return 0
    finally:
        gc.collect()
        gc.freeze()


def _copy(control: Connection, serve: Callable[[Connection], None]) -> int:
    """The process id of a copy of this process that serves the descriptor which follows the command."""
    descriptor = recv_handle(control)
    pid = os.fork()
    if pid:
        os.close(descriptor)
        return pid
    try:
        control.close()
        gc.enable()
        connection = Connection(descriptor)
        threading.Thread(target=_end_with_the_service, args=(descriptor,), daemon=True).start()
        serve(connection)
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
    """Answer calls: an empty message when one begins, then its pickled outcome."""
    from app.workers import stages  # noqa: PLC0415

    resource.setrlimit(resource.RLIMIT_DATA, (memory_mb * MEBIBYTE, memory_mb * MEBIBYTE))
    stages.touch_shared_memory()
    connection.send_bytes(b"")
    while True:
        call = connection.recv_bytes()
        connection.send_bytes(b"")
        connection.send_bytes(_outcome(call))


def _outcome(call: bytes) -> bytes:
    """The pickled pair of whether the call succeeded, and its result or its exception with the traceback as a note."""
    try:
        function, arguments = pickle.loads(call)  # noqa: S301  from the service itself
        return pickle.dumps((True, function(*arguments)), pickle.HIGHEST_PROTOCOL)
    except Exception as error:  # noqa: BLE001  handed to the caller
        error.add_note(f"In the worker process:\n{traceback.format_exc()}")
        try:
            content = pickle.dumps((False, error), pickle.HIGHEST_PROTOCOL)
            pickle.loads(content)  # noqa: S301
        except Exception:  # noqa: BLE001  not every exception can be pickled and read again
            return pickle.dumps((False, RuntimeError(traceback.format_exc())), pickle.HIGHEST_PROTOCOL)
        return content


def _compile(connection: Connection, names: Sequence[str]) -> None:
    """Compile stages; one message for every kernel ("kernel") and every stage ("stage")."""
    from app.workers import stages  # noqa: PLC0415

    try:
        stages.compile_stages(names, lambda message: connection.send_bytes(message.encode()))
    except OSError:
        raise
    except Exception:
        logger.exception("the compilation failed")


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3])
