"""The fork server: one process that loads the kernels and is copied.

It has one thread, so that a copy holds no lock that nobody will release, and puts everything it has loaded beyond the
reach of the garbage collector, so that the copies share its memory. Its standard input is a socket on which the service
sends one command at a time:

    fork MEMORY_MB   with a socket: a new worker that serves it; answers its process id
    reap PID         forget a worker that has ended
    warm NAME        calculate an example, so that its kernels are loaded

A process id is free for another process only after `reap`: the service can never signal a stranger.
"""

import gc
import importlib
import logging
import os
import signal
import socket
import sys

from app.warm_up import calculate
from app.workers import worker

LONGEST_COMMAND = 4096

logger = logging.getLogger("tribodrive")


def main() -> None:
    """Load the modules named on the command line, then obey commands until the service hangs up."""
    for name in sys.argv[1:]:
        importlib.import_module(name)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with socket.socket(fileno=os.dup(sys.stdin.fileno())) as control:
        null = os.open(os.devnull, os.O_RDWR)
        os.dup2(null, sys.stdin.fileno())  # no copy of this process keeps the socket open
        os.close(null)
        _freeze()
        while True:
            command, descriptors, _, _ = socket.recv_fds(control, LONGEST_COMMAND, 1)
            if not command:
                return
            control.sendall(_obey(command.decode().split(), descriptors, control).encode() + b"\n")


def _obey(command: list[str], descriptors: list[int], control: socket.socket) -> str:
    match command:
        case ["fork", memory_mb]:
            return _fork(socket.socket(fileno=descriptors[0]), int(memory_mb), control)
        case ["reap", pid]:
            os.waitpid(int(pid), 0)
            return "done"
        case ["warm", name]:
            return _warm(name)
        case _:
            return "unknown"


def _warm(name: str) -> str:
    """Load kernels; an example that fails is reported and costs nothing but speed."""
    try:
        calculate(name)
    except Exception:
        logger.exception("the example %s failed while kernels were loaded", name)
        return "failed"
    finally:
        _freeze()
    return "done"


def _fork(connection: socket.socket, memory_mb: int, control: socket.socket) -> str:
    with connection:
        pid = os.fork()
        if pid == 0:
            control.close()
            worker.serve(connection, memory_mb)
        return str(pid)


def _freeze() -> None:
    gc.collect()
    gc.freeze()


if __name__ == "__main__":
    main()
