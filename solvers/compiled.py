"""The two decorators with which numba compiles every kernel of this package.

A kernel is compiled when it is first called with arguments of given types. The machine code of the kernel is kept on
disk (see `solvers.kernel_cache`). In a kernel, a division by zero gives infinity or NaN, as in IEEE 754. No exception
is raised.
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

    If the code were not copied, numba would count the references to every array in a call. A kernel that takes many
    arrays may be called at every step of a loop, for example at every column of a film. The counting could then take
    twice as long as the calculation in the kernel.
    """
    return _compiled(function, forceinline=True)


def _compiled(function: Callable[P, R], *, forceinline: bool = False) -> Callable[P, R]:
    keep = FOLDER is not None
    compiled = numba.njit(cache=keep, error_model="numpy", nogil=True, forceinline=forceinline)(function)
    return cast("Callable[P, R]", compiled)
