"""The two decorators with which numba compiles every kernel of this package.

A kernel is compiled for the types of its first call. Its machine code is kept on disk (see `solvers.kernel_cache`). A
division by zero gives infinity or NaN, as in IEEE 754, instead of an exception.
"""

from collections.abc import Callable
from typing import ParamSpec, TypeVar, cast

import numba

from solvers.kernel_cache import FOLDER

P = ParamSpec("P")
R = TypeVar("R")


def kernel(function: Callable[P, R]) -> Callable[P, R]:
    """Compile a function of scalars and arrays."""
    return _compiled(function)


def inlined_kernel(function: Callable[P, R]) -> Callable[P, R]:
    """Compile a kernel whose code is copied into the kernels that call it.

    In a call that is not inlined, numba counts references to every array that is passed. If the kernel is one step of a
    loop and takes many arrays (for example a step for one column of a film), this counting can take twice as long as
    the step itself.
    """
    return _compiled(function, forceinline=True)


def _compiled(function: Callable[P, R], *, forceinline: bool = False) -> Callable[P, R]:
    keep = FOLDER is not None
    compiled = numba.njit(cache=keep, error_model="numpy", nogil=True, forceinline=forceinline)(function)
    return cast("Callable[P, R]", compiled)
