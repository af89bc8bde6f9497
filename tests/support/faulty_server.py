"""Run the service with additional endpoints that misbehave on demand: `python -m tests.support.faulty_server`.

This service loads the kernels of only two calculations, so that it starts in a fraction of the usual time.
"""

import os
import signal
import time
import warnings
from collections.abc import Sequence
from unittest.mock import patch

import numpy as np
from fastapi import FastAPI, Request

from app.command import serve
from app.main import create_app
from app.models.kernels import COUPLING, LOADS
from app.studies import points, runner
from app.studies.points import Chunk, Point, Question, solve_chunk, solve_point
from app.studies.requests import Overrides
from app.workers import start_up
from tests.support.server import HANGING, LONG, LONG_S, NAP, NAP_S

GROUPS = (COUPLING, LOADS)


def sleep(seconds: float) -> float:
    time.sleep(seconds)
    return seconds


def spin(seconds: float) -> float:
    """Keep the processor busy. Ignore SIGTERM, so that the process must be killed with SIGKILL."""
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        pass
    return seconds


def allocate(mebibytes: int) -> int:
    return int(np.ones(mebibytes * 2**17).size)


def crash() -> None:
    os.kill(os.getpid(), signal.SIGSEGV)


def warn() -> None:
    warnings.warn("deep inside", stacklevel=1)


def fail_deep_inside() -> None:
    raise ZeroDivisionError("deep inside")


PAUSES_S = {HANGING: 600.0, LONG: LONG_S, NAP: NAP_S}


def solve_point_after_a_pause(question: Question, overrides: Overrides) -> Point:
    time.sleep(max((PAUSES_S.get(value, 0.0) for value in overrides.values()), default=0.0))
    return solve_point(question, overrides)


def solve_chunk_with_pauses(question: Question, overrides: Sequence[Overrides], seconds: float) -> Chunk:
    """Solve a chunk of points in a worker, with a pause before some of the points.

    Like any other chunk, the chunk ends after the point at which it has taken long enough.
    """
    with patch.object(points, "solve_point", solve_point_after_a_pause):
        return solve_chunk(question, overrides, seconds)


def create_faulty_app() -> FastAPI:
    patch.object(runner, "solve_chunk", solve_chunk_with_pauses).start()
    patch.object(start_up, "KERNEL_GROUPS", GROUPS).start()
    app = create_app()

    @app.post("/sleep/{seconds}")
    async def _(http: Request, seconds: float) -> float:
        result: float = await app.state.pool.calculate(http, sleep, seconds)
        return result

    @app.post("/spin/{seconds}")
    async def _(http: Request, seconds: float) -> float:
        result: float = await app.state.pool.calculate(http, spin, seconds)
        return result

    @app.post("/allocate/{mebibytes}")
    async def _(http: Request, mebibytes: int) -> int:
        result: int = await app.state.pool.calculate(http, allocate, mebibytes)
        return result

    @app.post("/fail")
    async def _(http: Request) -> None:
        await app.state.pool.calculate(http, fail_deep_inside)

    @app.post("/crash")
    async def _(http: Request) -> None:
        await app.state.pool.calculate(http, crash)

    @app.post("/warn")
    async def _(http: Request) -> None:
        await app.state.pool.calculate(http, warn)

    @app.post("/bug")
    async def _() -> None:
        raise RuntimeError("a bug")

    return app


def __getattr__(name: str) -> FastAPI:
    """Create the application when uvicorn asks for `app`, and not on import, because workers import this module too."""
    if name != "app":
        raise AttributeError(name)
    return create_faulty_app()


if __name__ == "__main__":
    serve("tests.support.faulty_server:app")
