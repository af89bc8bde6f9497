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
from pathlib import Path
from typing import Any

ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS", "MKL_NUM_THREADS"), "1")

_notes = BufferingHandler(sys.maxsize)
"""Keeps the log records of a call. A worker returns these records, because its standard error is not read."""


@lru_cache(maxsize=1)
def prepare(memory_bytes: int, modules: Sequence[str]) -> int:
    """Load modules and limit the memory, at the first call only. Return the identifier of this process."""
    # Ctrl-C and the stop of systemd reach every process of the group. The service lets its calls end, and then ends the
    # workers itself.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    os.environ.update(ONE_THREAD)  # before numpy is loaded
    threading.Thread(target=_end_with_the_service, args=(os.getppid(),), daemon=True).start()
    gc.disable()  # imports leave no garbage, and the search for garbage takes a third of the time of the imports
    for name in modules:
        import_module(name)
    if modules:
        from app.workers.compiling import prepare_kernels  # noqa: PLC0415  needs what was just loaded

        prepare_kernels()
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


def perform(memory_bytes: int, modules: Sequence[str], file: Path | None, call: bytes) -> tuple[Any, list[str]]:
    """Call a pickled function with its arguments. Return the result and the lines that were logged during the call.

    `file` exists while a kernel is being compiled.
    Raises the error of the function, or RuntimeError with the traceback if this error cannot be pickled.
    """
    prepare(memory_bytes, modules)
    if modules:
        from app.workers.compiling import clock  # noqa: PLC0415  loaded by `prepare`

        clock.file = file
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
