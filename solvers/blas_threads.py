"""Limit the BLAS to one thread; for systems of a few hundred unknowns, more threads only cost time.

The workers of the service are started with one BLAS thread. In a notebook the BLAS has as many threads as the machine
has cores, and other code in the notebook may need these threads. A solver therefore sets the limit of one thread only
during its calls, and then restores the former limit.
"""

from contextlib import AbstractContextManager
from functools import cache

from threadpoolctl import ThreadpoolController


@cache
def libraries() -> ThreadpoolController:
    """Return the BLAS libraries that were loaded in this process when this function was called for the first time."""
    return ThreadpoolController().select(user_api="blas")


def one_blas_thread() -> AbstractContextManager[object]:
    """Limit every BLAS of this process to one thread inside a `with` block."""
    limits: AbstractContextManager[object] = libraries().limit(limits=1)
    return limits
