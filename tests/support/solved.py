"""Requests that were solved once in a test run are not solved again, neither in this process nor in the second one.

A solver is a function of its inputs, and its result cannot be changed, so that tests may share it.
"""

import fcntl
import os
import pickle
import time
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path
from typing import Any

from cachetools import LRUCache

Solver = Callable[[Any], Any]
SHARED_FROM_S = 0.1  # a quicker result is not worth its file
FOLDER = "SOLVED_REQUESTS"  # environment variable: where the processes of a run share results


def remember_solutions() -> None:
    """Let the endpoints of this process remember what they solved."""
    from app.calculations import CALCULATIONS  # noqa: PLC0415  a process that only hands out tests does not need it

    known: LRUCache[bytes, Any] = LRUCache(1000)
    for calculation in CALCULATIONS:
        object.__setattr__(calculation, "solve", _remembering(calculation.path, calculation.solve, known))


def _remembering(path: str, solver: Solver, known: LRUCache[bytes, Any]) -> Solver:
    def solve(inputs: Any) -> Any:
        key = sha256(pickle.dumps((path, inputs))).digest()
        if key not in known:
            known[key] = _shared(key.hex(), lambda: solver(inputs))
        return known[key]

    return solve


def _shared(name: str, compute: Callable[[], Any]) -> Any:
    """Compute a result, or read it from the file of another process, which waits meanwhile for its lock."""
    if FOLDER not in os.environ:
        return compute()
    with Path(os.environ[FOLDER], name).open("a+b") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        file.seek(0)
        if content := file.read():
            return pickle.loads(content)  # noqa: S301  of this run
        began = time.process_time()
        result = compute()
        if time.process_time() - began > SHARED_FROM_S:
            pickle.dump(result, file)
    return result
