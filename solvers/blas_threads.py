"""One thread of the BLAS for systems of a few hundred unknowns, where starting more takes longer than they save.

The workers of the service are started with one thread. A notebook has as many as the machine has cores, and what else
runs in it may want them, so a solver asks for one thread around its calls and gives back what was there.
"""

from contextlib import AbstractContextManager
from functools import cache

from threadpoolctl import ThreadpoolController


@cache
def libraries() -> ThreadpoolController:
    """Return the libraries of the BLAS that this process has loaded when it is first asked."""
    return ThreadpoolController().select(user_api="blas")


def one_blas_thread() -> AbstractContextManager[object]:
    """Let every BLAS of this process use one thread until the end of a block."""
    limits: AbstractContextManager[object] = libraries().limit(limits=1)
    return limits
