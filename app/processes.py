"""What the operating system is asked about processes; Linux knows all of it, other systems some."""

import ctypes
import gc
import os
import resource
import runpy
import signal
import sys
from pathlib import Path

PR_SET_PDEATHSIG = 1


def child_command(module: str, *arguments: str) -> list[str]:
    """The command that runs a module in a process that never outlives this one, garbage collection still off."""
    return [sys.executable, "-m", __spec__.name, str(os.getpid()), module, *arguments]


def _run_as_child(parent: str, module: str) -> None:
    """Run the module; before it is loaded, which may take a while, the kernel is told to end it with its parent."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    if str(os.getppid()) == parent:
        gc.disable()  # until the module is there: imports leave no garbage, and looking for it takes a third of them
        sys.argv = [module, *sys.argv[3:]]
        runpy.run_module(module, run_name="__main__", alter_sys=True)


def is_stopped(pid: int) -> bool:
    """Whether the process was stopped by a signal or a debugger."""
    try:
        status = Path(f"/proc/{pid}/stat").read_bytes()
    except OSError:
        return False
    return status[status.rindex(b")") + 2 :][:1] in {b"T", b"t"}


def descriptor_limit() -> int:
    """How many files and sockets this process may have open."""
    return resource.getrlimit(resource.RLIMIT_NOFILE)[0]


if __name__ == "__main__":
    _run_as_child(*sys.argv[1:3])
