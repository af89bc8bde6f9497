"""One thread of the BLAS for systems of a few hundred unknowns, where starting more takes longer than they save.

The workers of the service are started with one thread. A notebook has as many as the machine has cores, and what else
runs in it may want them, so a solver asks for one thread around its calls and gives back what was there.
"""

import ctypes
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path

MAPS = Path("/proc/self/maps")
# As wheels of SciPy and NumPy, distributions and OpenBLAS itself name them.
NAMES = ("scipy_openblas_{}_num_threads", "scipy_openblas_{}_num_threads64_", "openblas_{}_num_threads")


@contextmanager
def one_blas_thread() -> Iterator[None]:
    """Let every OpenBLAS of this process use one thread until the end of the block.

    Another BLAS, and a system that does not tell which libraries a process has, are left as they are.
    """
    before = [(write, threads) for read, write in _libraries() if (threads := read()) != 1]
    for write, _ in before:
        write(1)
    try:
        yield
    finally:
        for write, threads in before:
            write(threads)


@cache
def _libraries() -> list[tuple[Callable[[], int], Callable[[int], None]]]:
    """Functions that read and write the number of threads of every OpenBLAS that is loaded."""
    maps = MAPS.read_text() if MAPS.is_file() else ""
    libraries = []
    for path in sorted(set(re.findall(r"\S*/[^/\s]*openblas[^/\s]*\.so\S*", maps))):
        library = ctypes.CDLL(path)
        for name in NAMES:
            with suppress(AttributeError):  # named otherwise
                libraries.append((getattr(library, name.format("get")), getattr(library, name.format("set"))))
    return libraries
