"""The decorators with which numba compiles every kernel of this package.

A kernel is compiled when it is first called with arguments of given types. The machine code of the kernel is kept on
disk (see `solvers.kernel_cache`). In a kernel, a division by zero gives infinity or NaN, as in IEEE 754. No exception
is raised.
"""

import sys
from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar, cast

import numba
from numba.core import event
from numba.extending import register_jitable

from solvers.kernel_cache import FOLDER

P = ParamSpec("P")
R = TypeVar("R")
SECONDS_EACH = 2.2  # s of one core, mean over all kernels
OPTIONS: dict[str, Any] = {"error_model": "numpy", "nogil": True, "no_cfunc_wrapper": True}  # no C code calls kernels


def kernel(function: Callable[P, R]) -> Callable[P, R]:
    """Compile a function of scalars and arrays that Python calls."""
    compiled = numba.njit(cache=FOLDER is not None, **OPTIONS)(function)
    announcement.add(compiled)
    return cast("Callable[P, R]", compiled)


def inner_kernel(function: Callable[P, R]) -> Callable[P, R]:
    """Compile a function that only kernels call, without what makes it callable from Python.

    That would take a third of its compilation. Python runs it uncompiled; a test can compile it with `kernel`.
    """
    return register_jitable(**OPTIONS)(function)


def inlined_kernel(function: Callable[P, R]) -> Callable[P, R]:
    """Compile an inner kernel into the kernels that call it.

    Otherwise numba counts the references to every array in a call, which at every column of a film may take twice as
    long as the calculation.
    """
    return register_jitable(forceinline=True, **OPTIONS)(function)


class Announcement(event.Listener):
    """Says once, on standard error, that kernels are being compiled: a first call may take half a minute."""

    def __init__(self) -> None:
        self._kernels: list[Any] = []
        self._is_mute = False

    def add(self, kernel: Any) -> None:
        """Count a kernel of this package."""
        self._kernels.append(kernel)

    def mute(self) -> None:
        """Say nothing, as in the service, which reports its progress itself."""
        self._is_mute = True

    def on_start(self, event: event.Event) -> None:
        """Write the line when the first kernel of this package is compiled."""
        if self._is_mute or event.data["dispatcher"] not in self._kernels:
            return
        self._is_mute = True
        missing = sum(not kernel.stats.cache_hits for kernel in self._kernels)
        seconds = max(1, round(SECONDS_EACH * missing))
        line = f"tribodrive: compiling up to {missing} kernels, once after installation, about {seconds} s"
        print(line, file=sys.stderr, flush=True)  # noqa: T201  meant for the user at the terminal

    def on_end(self, event: event.Event) -> None:
        """Say nothing."""


announcement = Announcement()
event.register("numba:compile", announcement)
