"""The one way kernels are compiled: by numba, typed by use, cached on disk, IEEE division."""

from collections.abc import Callable
from typing import ParamSpec, TypeVar, cast

from numba import njit

P = ParamSpec("P")
R = TypeVar("R")


def kernel(function: Callable[P, R]) -> Callable[P, R]:
    """Compile a function of scalars and arrays; division by zero follows IEEE instead of raising."""
    return cast("Callable[P, R]", njit(cache=True, error_model="numpy", nogil=True)(function))
