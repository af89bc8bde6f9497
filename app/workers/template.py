"""The fork server: one process that loads the kernels and is copied.

It has one thread, so that a copy holds no lock that nobody will release, and puts everything it has loaded beyond the
reach of the garbage collector, so that the copies share its memory. Its standard input is a socket. On it the template
says that it is ready, and the service then sends one command at a time:

    fork MEMORY_MB   with a socket: a new worker that serves it; answers its process id
    compile STAGES   with a socket: a process that compiles these stages (with commas between) and tells the socket
    reap PID         forget a process that has ended
    warm STAGE       load the kernels of a stage

Garbage collection is off here, and on in every copy.

A process id is free for another process only after `reap`: the service can never signal a stranger.
"""

import gc
import logging
import os
import signal
import socket
import sys
from collections.abc import Callable
from functools import partial
from typing import NoReturn

from app.warm_up import stage_of, warm
from app.workers import compiler, worker

LONGEST_COMMAND = 4096

logger = logging.getLogger("tribodrive")


def main() -> None:
    """Obey commands until the service hangs up."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with socket.socket(fileno=os.dup(sys.stdin.fileno())) as control:
        null = os.open(os.devnull, os.O_RDWR)
        os.dup2(null, sys.stdin.fileno())  # no copy of this process keeps the socket open
        os.close(null)
        gc.freeze()
        control.sendall(b"ready\n")
        while True:
            command, descriptors, _, _ = socket.recv_fds(control, LONGEST_COMMAND, 1)
            if not command:
                return
            control.sendall(_obey(command.decode().split(" ", 1), descriptors, control).encode() + b"\n")


def _obey(command: list[str], descriptors: list[int], control: socket.socket) -> str:
    match command:
        case ["fork", memory_mb]:
            return _copy(control, descriptors[0], partial(worker.serve, memory_mb=int(memory_mb)))
        case ["compile", stages]:
            return _copy(control, descriptors[0], partial(compiler.serve, stages=stages.split(",")))
        case ["reap", pid]:
            os.waitpid(int(pid), 0)
            return "done"
        case ["warm", name]:
            return _warm(name)
        case _:
            return "unknown"


def _copy(control: socket.socket, descriptor: int, serve: Callable[[socket.socket], NoReturn]) -> str:
    """Another process like this one, which serves the socket."""
    with socket.socket(fileno=descriptor) as connection:
        pid = os.fork()
        if pid == 0:
            control.close()
            gc.enable()
            serve(connection)
        return str(pid)


def _warm(name: str) -> str:
    """Load a stage; one that fails is reported and costs nothing but speed."""
    try:
        warm(stage_of(name))
    except Exception:
        logger.exception("%s failed while its kernels were loaded", name)
        return "failed"
    finally:
        gc.collect()
        gc.freeze()
    return "done"


if __name__ == "__main__":
    main()
