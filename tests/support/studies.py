"""Functions that make a study of an example, run a study in this process, and read the fault of a refused study."""

import asyncio
import json
from collections.abc import Callable
from typing import Any

import pytest

from app.errors import InvalidBody, Unprocessable, faults_of
from app.examples import examples
from app.http.streams import encoded, guarded
from app.studies.runner import Clock, Pool, Study, json_line
from tests.support.pools import InlinePool

Planner = Callable[[Any, int, float], Study]


def study_of(example: str, **parts: Any) -> dict[str, Any]:
    """Return the body of a study of an example. Parts that are None are left out of the body."""
    named = {"endpoint": examples()[example].endpoint, "request": examples()[example].request, **parts}
    return {name: part for name, part in named.items() if part is not None}


def lines_of(study: Study, pool: Pool | None = None, seconds: float = 600.0) -> list[dict[str, Any]]:
    """Run a study in this process, and return all lines as a client reads the lines."""

    async def run() -> bytes:
        clock = Clock(study.total)
        lines = guarded(study.lines(pool or InlinePool(), clock), clock, seconds)
        return b"".join([piece async for piece in encoded(lines, json_line)])

    return [json.loads(line) for line in asyncio.run(run()).splitlines()]


def timeless(lines: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return the lines of a study without lines of progress and without the elapsed time in the other lines."""
    told = (line for line in lines if line["type"] != "progress")
    return [{key: value for key, value in line.items() if key != "elapsed_s"} for line in told]


def fault_of(planner: Planner, body: object, most: int = 2500) -> tuple[str, str, str]:
    """Check that a study refuses a body, and return the pointer, the code and the message of the first fault."""
    with pytest.raises((Unprocessable, InvalidBody)) as caught:
        planner(body, most, 30.0)
    fault = faults_of(caught.value)[0]
    return fault["pointer"], fault["code"], fault["message"]
