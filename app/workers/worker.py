"""What runs in a worker process: its preparation, which limits numpy's threads before numpy is loaded, then calls."""

import gc
import logging
import os
import pickle
import signal
import threading
import time
import traceback
from collections.abc import Sequence
from contextlib import suppress
from functools import lru_cache
from importlib import import_module
from typing import Any

ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS", "MKL_NUM_THREADS"), "1")

_said: list[str] = []


class _Notes(logging.Handler):
    """Keeps what is logged for the answer of the call: the standard error of a worker leads nowhere."""

    def emit(self, record: logging.LogRecord) -> None:
        _said.append(self.format(record))


@lru_cache(maxsize=1)
def prepare(memory_bytes: int, modules: Sequence[str]) -> None:
    """Prepare this process for calls, once: load modules, and limit memory where the platform can."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches every process of the terminal
    os.environ.update(ONE_THREAD)
    threading.Thread(target=_end_with_the_service, args=(os.getppid(),), daemon=True).start()
    gc.disable()  # imports leave no garbage, and looking for it takes a third of their time
    for name in modules:
        import_module(name)
    gc.freeze()
    gc.enable()
    logging.captureWarnings(capture=True)
    logging.root.addHandler(_Notes())
    with suppress(ImportError, OSError, ValueError):
        import resource  # noqa: PLC0415  not everywhere

        resource.setrlimit(resource.RLIMIT_DATA, (memory_bytes, memory_bytes))


def _end_with_the_service(service: int) -> None:
    """End this process, whatever it does, when its parent is another one than the service."""
    while os.getppid() == service:
        time.sleep(0.5)
    os._exit(1)


def perform(memory_bytes: int, modules: Sequence[str], call: bytes) -> tuple[Any, list[str]]:
    """Return the result of a pickled function and its arguments, and what was logged; raises what that raises."""
    prepare(memory_bytes, modules)
    _said.clear()
    try:
        function, arguments = pickle.loads(call)  # noqa: S301  from the service itself
        return function(*arguments), _said
    except Exception as error:
        text = traceback.format_exc()
        error.add_note(f"In the worker process:\n{text}")
        try:
            pickle.loads(pickle.dumps(error))  # noqa: S301
        except Exception:  # noqa: BLE001
            raise RuntimeError(text) from None  # not every exception can be pickled and read again
        raise
