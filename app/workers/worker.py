"""The functions that run in a worker process: `prepare` prepares the process, and `perform` executes calls."""

import gc
import logging
import os
import pickle
import signal
import sys
import threading
import time
import traceback
from collections.abc import Sequence
from contextlib import suppress
from functools import lru_cache
from importlib import import_module
from logging.handlers import BufferingHandler
from typing import Any

ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS", "MKL_NUM_THREADS"), "1")

_notes = BufferingHandler(sys.maxsize)
"""Keeps the log records of a call. A worker returns these records, because its standard error is not read."""


@lru_cache(maxsize=1)
def prepare(memory_bytes: int, modules: Sequence[str]) -> int:
    """Load modules and limit the memory, at the first call only. Return the identifier of this process."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # ignored here, because Ctrl-C reaches every process of the terminal
    os.environ.update(ONE_THREAD)  # before numpy is loaded
    threading.Thread(target=_end_with_the_service, args=(os.getppid(),), daemon=True).start()
    gc.disable()  # imports leave no garbage, and the search for garbage takes a third of the time of the imports
    for name in modules:
        import_module(name)
    gc.freeze()
    gc.enable()
    logging.captureWarnings(capture=True)
    logging.root.addHandler(_notes)
    with suppress(ImportError, OSError, ValueError):
        import resource  # noqa: PLC0415  not on all platforms

        resource.setrlimit(resource.RLIMIT_DATA, (memory_bytes, memory_bytes))
    return os.getpid()


def _end_with_the_service(service: int) -> None:
    """End this process, even during a call, as soon as the service is no longer the parent process."""
    while os.getppid() == service:
        time.sleep(0.5)
    os._exit(1)


def perform(memory_bytes: int, modules: Sequence[str], call: bytes) -> tuple[Any, list[str]]:
    """Call a pickled function with its arguments. Return the result and the lines that were logged during the call.

    Raises the error of the function, or RuntimeError with the traceback if this error cannot be pickled.
    """
    prepare(memory_bytes, modules)
    _notes.flush()
    try:
        function, arguments = pickle.loads(call)  # noqa: S301  from the service itself
        return function(*arguments), [_notes.format(record) for record in _notes.buffer]
    except Exception as error:
        text = traceback.format_exc()
        error.add_note(f"In the worker process:\n{text}")
        try:
            pickle.loads(pickle.dumps(error))  # noqa: S301
        except Exception:  # noqa: BLE001
            raise RuntimeError(text) from None
        raise
