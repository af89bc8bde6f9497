"""Studies in a script: `study` solves one with any `map`, and goes on after a crash from the points that were kept."""

import asyncio
import json
import time
from collections.abc import Awaitable, Callable, Generator, Iterable, Iterator
from concurrent.futures import BrokenExecutor, CancelledError
from contextlib import contextmanager
from functools import partial
from itertools import count, takewhile
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Any

from app.errors import PoolLost, StudyEnded, Unprocessable, WorkerLost
from app.spreadsheet import frame_of
from app.studies.kept import Kept, case_of_point
from app.studies.kinds import KINDS
from app.studies.points import Chunk, solve_chunk
from app.studies.runner import Clock, Line, Lines, Progress, Study, json_line

if TYPE_CHECKING:
    from pandas import DataFrame

Map = Callable[[Callable[[Any], Any], list[Any]], Iterable[Any]]

MOST_POINTS = 1_000_000  # of a study; the bodies of studies allow no more
LOST = "the processes behind the map are lost; with `kept` the study goes on where it was"
BY_DASK = {"KilledWorker": WorkerLost, "ClosedClientError": PoolLost, "CommClosedError": PoolLost}  # an extra: by name


class Later:
    """A call that is waited for where its result is needed, while nothing else runs in this thread."""

    def __init__(self, function: Callable[..., Any], *arguments: Any) -> None:
        self._call: Callable[[], Any] | None = partial(function, *arguments)

    def result(self) -> Any:
        assert self._call is not None
        return self._call()

    def __await__(self) -> Generator[None, None, Any]:
        yield from ()
        return self.result()

    def cancel(self) -> None:
        self._call = None  # with the last reference to its future, Dask takes a task back


class MapPool:
    """The processes behind a `map`, and before them the points that were kept."""

    chunk_s, longest_s = 0.5, 2.0
    ahead = 20  # chosen: 10 s of work wait for each process, by which Dask decides to add workers

    def __init__(self, map: Map, kept: Kept | None) -> None:  # noqa: A002
        self._map, self._kept = map, kept
        self._numbers = count()
        self._began, self._worked_s = time.monotonic(), 0.0

    @property
    def slots(self) -> int:
        """The number of busy processes by their computing time so far; a map does not say how many it has."""
        return max(1, round(self._worked_s / max(time.monotonic() - self._began, 1e-3)))

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Later:
        """Give a call to the map; of a chunk, give only the points before the first that was kept."""
        kept = self._kept
        if kept is None or function is not solve_chunk:
            return self._sent(function, *arguments)
        question, overrides, seconds = arguments
        cases = [case_of_point(question, each) for each in overrides]
        if known := kept.leading(cases):
            return Later(Chunk, known, None)
        missing = len([*takewhile(lambda case: case not in kept, cases)])
        return Later(_keeping, kept, cases, self._sent(solve_chunk, question, overrides[:missing], seconds))

    def _sent(self, function: Callable[..., Any], *arguments: Any) -> Later:
        # The number makes equal calls differ: Dask would give the second the result of the first, even of a lost one.
        with _losses_told():
            return Later(self._received, self._map(solved, [(function, arguments, next(self._numbers))]))

    def _received(self, results: Iterable[Any]) -> Any:
        with _losses_told():
            (result,) = results
            value = result.result() if hasattr(result, "result") else result  # maps of Dask give futures
        if isinstance(value, Chunk):
            self._worked_s += value.seconds or 0.0
        return value


def _keeping(kept: Kept, cases: list[str], call: Later) -> Chunk:
    chunk: Chunk = call.result()
    kept.add(cases, chunk)
    return chunk


def solved(call: tuple[Callable[..., Any], tuple[Any, ...], int]) -> Any:
    function, arguments, _ = call
    return function(*arguments)


@contextmanager
def _losses_told() -> Iterator[None]:
    """Raise PoolLost instead of the errors that executors and Dask raise if their processes are gone."""
    try:
        yield
    except (BrokenExecutor, CancelledError, asyncio.CancelledError, ConnectionError) as error:
        raise PoolLost(LOST) from error
    except Exception as error:
        if lost := BY_DASK.get(type(error).__name__):
            raise lost(LOST) from error
        raise


class Run:
    """A study in a script. Iterating over it solves the study; `done` of `total` points are solved."""

    def __init__(self, plan: Study, map: Map, kept: Kept | None) -> None:  # noqa: A002
        self.plan = plan
        self._map, self._kept = map, kept
        self._clock = Clock(plan.total)

    @property
    def progress(self) -> Progress:
        """How many points are solved, of how many, and how long the rest will take."""
        return self._clock.progress

    @property
    def done(self) -> int:
        return self._clock.done

    @property
    def total(self) -> int:
        """The number of points; a search finds out how many it needs while it runs."""
        return self._clock.total

    def __iter__(self) -> Iterator[Line]:
        self._clock = Clock(self.plan.total)
        for group in _stepped(self.plan.lines(MapPool(self._map, self._kept), self._clock)):
            for line in group:
                yield json.loads(json_line(line))

    def frame(self) -> "DataFrame":
        """Solve the study and return its results as a table.

        Returns
        -------
        pandas.DataFrame
            The table that `frame` of a study of `app.client` returns.

        Raises
        ------
        StudyEnded
            If the study ends with an error.
        """
        *lines, end = (line for line in self if line["type"] != "progress")
        if end["type"] == "error":
            raise StudyEnded(end["message"])
        has_header = bool(lines) and "model_version" in lines[0]
        return frame_of(lines[0] if has_header else {}, lines[has_header:], end)


def study(endpoint: str, body: Line, map: Map = map, kept: str | Path | None = None) -> Run:  # noqa: A002
    """Solve a study without a server, on the processes behind any `map`.

    Parameters
    ----------
    endpoint : str
        Address of the study, such as "/v1/sweep".
    body : dict
        Body of the request, in the same form as over HTTP, of at most a million points.
    map : callable
        What calls a function for each item of a list and gives the results in order: `map` itself, `map` of an executor
        of processes or of mpi4py, `imap` of a `multiprocessing.Pool`, `map` of a Dask client (whose futures are waited
        for). Batches of about half a second go through it.
    kept : str or path
        File in which every solved point is kept by its case. A second run solves what is missing and gives the same
        lines. None: nothing is kept.

    Returns
    -------
    Run
        The study. Iterating over it yields the lines that the service sends, as dictionaries, except those of progress
        that the service sends between results; `frame` returns a table.

    Raises
    ------
    InvalidBody
        If the body is not valid; its `faults` have pointer, code and message.
    Unprocessable
        If there is no such study, or if it cannot be solved.
    OtherSources
        If other solvers calculated the points that were kept.
    ValueError
        If `kept` names a file that holds anything else.

    Examples
    --------
    >>> from app.examples import study_bodies
    >>> body = study_bodies("/v1/sweep")["cases"]["value"]
    >>> [line["type"] for line in study("/v1/sweep", body)][-1]
    'end'
    """
    plans = {kind.path: kind for kind in KINDS}
    if endpoint not in plans:
        raise Unprocessable("unknown_endpoint", f"there is no such study; the studies are {', '.join(plans)}")
    return Run(plans[endpoint](body, MOST_POINTS, inf), map, None if kept is None else Kept(Path(kept)))


def _stepped(lines: Lines) -> Iterator[list[Line]]:
    """Yield the groups of an asynchronous generator that waits for nothing but `Later`: no event loop is needed.

    A notebook has an event loop of its own, in which no other can run.
    """
    try:
        while (group := _now(anext(lines, None))) is not None:
            yield group
    finally:
        _now(lines.aclose())


def _now(step: Awaitable[Any]) -> Any:
    waiting = step.__await__()
    try:
        next(waiting)
    except StopIteration as end:
        return end.value
    raise RuntimeError("a study waits for something else than its points")
