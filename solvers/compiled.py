"""The two decorators with which every kernel of this package is compiled by numba.

A kernel is typed by its first call, its machine code is kept on disk (see `solvers.kernel_cache`), and a division by
zero gives infinity or NaN as IEEE 754 says instead of an exception.
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
    """Compile a kernel that is copied into the kernels that call it, in place of a call.

    A call counts references to every array handed over. For a step of a loop that takes groups of arrays, as for one
    column of a film, that can cost twice the work itself.
    """
    return _compiled(function, forceinline=True)


def _compiled(function: Callable[P, R], *, forceinline: bool = False) -> Callable[P, R]:
    keep = FOLDER is not None
    compiled = numba.njit(cache=keep, error_model="numpy", nogil=True, forceinline=forceinline)(function)
    return cast("Callable[P, R]", compiled)
