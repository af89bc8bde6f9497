"""A client of the service for scripts and notebooks; besides this package it needs only httpx.

    from app.client import Tribodrive

    service = Tribodrive("http://127.0.0.1:8000")
    answer = service.coupling({"coupling": {...}, "operation": {...}})
    table = service.sweep({"endpoint": "/v1/coupling", "request": {...}, "vary": [...]}).frame()

Requests and answers are dictionaries with the content of the JSON bodies. `AsyncTribodrive` has the same methods for
asyncio. If the service is too busy to answer a request, the client repeats the request after the time that the service
states in `Retry-After`.
"""

import asyncio
import json
import time
from abc import ABC, abstractmethod
from collections.abc import AsyncIterator, Awaitable, Iterator
from contextlib import contextmanager
from math import inf
from typing import TYPE_CHECKING, Any, Generic, Self, TypeVar

import httpx

from app.errors import sentence
from app.spreadsheet import frame_of

if TYPE_CHECKING:
    from pandas import DataFrame

__all__ = ["AsyncStudy", "AsyncTribodrive", "ProblemError", "ServiceError", "Study", "StudyError", "Tribodrive"]

Json = dict[str, Any]
Answer = TypeVar("Answer")
Stream = TypeVar("Stream")
Http = TypeVar("Http", bound=httpx.Client | httpx.AsyncClient)

ADDRESS = "http://127.0.0.1:8000"
OPTIONS: dict[str, Any] = {
    "timeout": 120.0,  # s; longer than the service waits for its kernels (90 s), and than its default deadline (30 s)
    "limits": httpx.Limits(keepalive_expiry=3.0),  # s; the service closes idle connections after 5 s
}
PATIENCE_S = 120.0  # s; default of `patience_s`; chosen: four times the service's deadline
CUT_OFF = "the connection was closed before the study's end"
LEAST_WAIT_S = 0.25  # s; shortest wait before a busy service is asked again; chosen


class ServiceError(Exception):
    """No valid answer: the service reports a problem, a study ended early, or the answer has the wrong form."""


class ProblemError(ServiceError):
    """An answer with a status other than 200.

    Attributes
    ----------
    status : int
        HTTP status.
    code : str
        Stable name of the problem. It is the last part of `type` in the answer.
    errors : list of dict
        Errors of the fields, with `pointer` (JSON Pointer into the request), `code` and `message`.
    """

    def __init__(self, response: httpx.Response) -> None:
        try:
            document = _json_of(response)
        except ServiceError:  # the answer comes from a proxy and not from the service
            document = {}
        self.status = response.status_code
        self.code = str(document.get("type", "")).rpartition(":")[2]
        errors = document.get("errors")
        self.errors: list[Json] = (
            [error for error in errors if isinstance(error, dict)] if isinstance(errors, list) else []
        )
        texts = ({name: str(error.get(name) or "") for name in ("pointer", "message")} for error in self.errors)
        faults = "; ".join(map(sentence, texts))
        super().__init__(f"{self.status} {self.code}: {faults or document.get('detail', '')}")


class StudyError(ServiceError):
    """A study that ended before its last line, because of its deadline, an error or a lost connection."""


class _Endpoints(ABC, Generic[Answer, Stream]):
    """The methods of both clients, with one method per endpoint. `request` is the body of the request."""

    @abstractmethod
    def solve(self, endpoint: str, request: Json) -> Answer:
        """Post a request to an endpoint and return the answer.

        Parameters
        ----------
        endpoint : str
            Address of the calculation, such as "/v1/coupling".
        request : dict
            Body of the request.

        Returns
        -------
        dict
            The answer.

        Raises
        ------
        ProblemError
            If the service answers with a problem.
        """

    @abstractmethod
    def study(self, endpoint: str, request: Json, *, progress: bool = False) -> Stream:
        """Open a study. The study starts when its results are read.

        Parameters
        ----------
        endpoint : str
            Address of the study, such as "/v1/sweep".
        request : dict
            Body of the request.
        progress : bool
            True to show a progress bar.

        Returns
        -------
        Study or AsyncStudy
            The study. Iterate over the study to get its results, or call its method `frame` to get a table.
        """

    def coupling(self, request: Json) -> Answer:
        """Calculate load, lubrication, friction, axial thrust and losses of a gear coupling."""
        return self.solve("/v1/coupling", request)

    def sleeve_orbit(self, request: Json) -> Answer:
        """Calculate path and inertia force of a floating sleeve."""
        return self.solve("/v1/coupling/sleeve-orbit", request)

    def recommendation(self, request: Json) -> Answer:
        """Find the crowning with the best film over a range of misalignment."""
        return self.solve("/v1/coupling/recommendation", request)

    def pumping(self, request: Json) -> Answer:
        """Calculate the pumping of air and mist between the teeth."""
        return self.solve("/v1/pumping", request)

    def choking_speed(self, request: Json) -> Answer:
        """Find the speeds at which the flow out of the tooth spaces becomes sonic."""
        return self.solve("/v1/pumping/choking-speed", request)

    def load_distribution(self, request: Json) -> Answer:
        """Calculate load, pressure, transmission error and loss of a modified gear pair."""
        return self.solve("/v1/scuffing/load-distribution", request)

    def scuffing(self, request: Json) -> Answer:
        """Calculate flash temperature, film thickness and safety factor against scuffing of a gear pair."""
        return self.solve("/v1/scuffing", request)

    def line_contact(self, request: Json) -> Answer:
        """Calculate a thermal elastohydrodynamic line contact."""
        return self.solve("/v1/scuffing/line-contact", request)

    def drive_train(self, request: Json) -> Answer:
        """Calculate a complete gear unit: couplings, shafts, bearings, mesh."""
        return self.solve("/v1/drive-train", request)

    def warm_up(self, request: Json) -> Answer:
        """Calculate the warm-up of a gear unit: temperatures, load and safety over time."""
        return self.solve("/v1/drive-train/warm-up", request)

    def sweep(self, request: Json, *, progress: bool = False) -> Stream:
        """Solve one endpoint at many points: a grid, a list of cases or a random sample."""
        return self.study("/v1/sweep", request, progress=progress)

    def solve_for(self, request: Json, *, progress: bool = False) -> Stream:
        """Find the input at which an output has a wanted value, or is least or greatest; the answers are in the end."""
        return self.study("/v1/solve-for", request, progress=progress)

    def spectrum(self, request: Json, *, progress: bool = False) -> Stream:
        """Solve a request with tolerances for a load spectrum. The last line states the probabilities."""
        return self.study("/v1/spectrum", request, progress=progress)

    def sensitivity(self, request: Json, *, progress: bool = False) -> Stream:
        """Rank the inputs by their influence on the outputs."""
        return self.study("/v1/sensitivity", request, progress=progress)

    def corners(self, request: Json, *, progress: bool = False) -> Stream:
        """Solve a gear unit at all combinations of its uncertain inputs."""
        return self.study("/v1/drive-train/corners", request, progress=progress)

    def design(self, request: Json, *, progress: bool = False) -> Stream:
        """Find the flank correction that gives a gear unit the best result at the worst corner."""
        return self.study("/v1/drive-train/design", request, progress=progress)


class _Study(Generic[Http]):
    """Reader of the lines of a study. The lines are a header, results, reports of progress and an end."""

    def __init__(self, http: Http, endpoint: str, request: Json, patience_s: float, *, progress: bool) -> None:
        self.header: Json = {}
        self.end: Json = {}
        self._http = http
        self._endpoint = endpoint
        self._request = request
        self._patience_s = patience_s
        self._progress = progress
        self._bar: Any = None
        self._points = set[int]()  # the indices of the points that have arrived

    def _begin(self) -> float:
        """Reset the study before a new run.

        Return the reading of the monotonic clock [s] after which the client stops repeating a refused request.
        """
        self.header, self.end = {}, {}
        self._points.clear()
        if self._progress:
            from tqdm.auto import tqdm  # noqa: PLC0415  only progress bars need it

            self._bar = tqdm()
        return time.monotonic() + self._patience_s

    def _results(self, text: str) -> Iterator[Json]:
        """Process one line of a study's answer, and yield its content if the line is a result.

        Raises `StudyError` if the line reports an error, or if the line does not belong to a study.
        """
        try:
            yield from self._process(json.loads(text))
        except (ValueError, LookupError, TypeError, RecursionError) as error:
            raise StudyError(f"the service sent a line that does not belong to a study: {text[:100]}") from error

    def _process(self, line: Json) -> Iterator[Json]:
        match line["type"]:
            case "error":
                raise StudyError(f"{line['code']}: {line['message']}")
            case "progress":
                self._show(line["done"], line["total"])
            case "end":
                if "axes" in self.header and len(self._points) != self.header["total"]:
                    raise StudyError(f"the study has {self.header['total']} points, but {len(self._points)} arrived")
                self.end = line
                if total := self.header.get("total"):
                    self._show(total, total)
            case _ if "case" in line and "outputs" in line:
                self.header = line
            case kind:
                if kind == "point":
                    if line["index"] in self._points:
                        raise StudyError(f"the service sent the point {line['index']} twice")
                    self._points.add(line["index"])
                    self._show(line["index"] + 1, self.header["total"])
                yield line

    def _show(self, done: int, total: int) -> None:
        if self._bar is not None:
            self._bar.total = total
            self._bar.update(done - self._bar.n)

    def _finish(self) -> None:
        if self._bar is not None:
            self._bar.close()
        if not self.end:
            raise StudyError(CUT_OFF)


class Study(_Study[httpx.Client]):
    """A study. Iterate over its results, or call `frame` for a table of all results.

    `header` is the first line of the study, and is empty until the first line has been read. `end` is the last line,
    and is empty until the last line has been read.
    """

    def __iter__(self) -> Iterator[Json]:
        """Run the study and yield its results as they arrive.

        Yields
        ------
        dict
            A line of the study that is a result.

        Raises
        ------
        ProblemError
            If the service answers with a problem.
        StudyError
            If the study ends before its last line.
        """
        give_up = self._begin()
        while True:
            with _connected(), self._http.stream("POST", self._endpoint, json=self._request) as response:
                if response.is_success:
                    with _connected(StudyError, CUT_OFF):
                        for text in response.iter_lines():
                            yield from self._results(text)
                    return self._finish()
                response.read()
            time.sleep(_wait_s(response, give_up))

    def frame(self) -> "DataFrame":
        """Run the study and return its results as a table.

        Returns
        -------
        pandas.DataFrame
            One row per result. The table of a sweep has one column per varied input and one column per output. The
            table of a spectrum has one row per load case, or one row per point if the request asks for the points.
        """
        results = list(self)
        return frame_of(self.header, results, self.end)


class AsyncStudy(_Study[httpx.AsyncClient]):
    """A study. Iterate over its results with `async for`, or await `frame` for a table of all results."""

    async def __aiter__(self) -> AsyncIterator[Json]:
        """Run the study and yield its results as they arrive.

        Yields
        ------
        dict
            A line of the study that is a result.

        Raises
        ------
        ProblemError
            If the service answers with a problem.
        StudyError
            If the study ends before its last line.
        """
        give_up = self._begin()
        while True:
            with _connected():
                async with self._http.stream("POST", self._endpoint, json=self._request) as response:
                    if response.is_success:
                        with _connected(StudyError, CUT_OFF):
                            async for text in response.aiter_lines():
                                for line in self._results(text):
                                    yield line
                        self._finish()
                        return
                    await response.aread()
            await asyncio.sleep(_wait_s(response, give_up))

    async def frame(self) -> "DataFrame":
        """Run the study and return its results as a table, in the same form as `Study.frame`.

        Returns
        -------
        pandas.DataFrame
            One row per result.
        """
        results = [line async for line in self]
        return frame_of(self.header, results, self.end)


class Tribodrive(_Endpoints[Json, Study]):
    """A client of the service at `url`.

    Parameters
    ----------
    url : str
        Address of the service. If the service has a path prefix, the address includes the prefix.
    patience_s : float
        Longest time during which a request is repeated because the service is busy or warming up [s].
    **options : Any
        Options of `httpx.Client`, such as `auth`, `headers`, `verify`, `timeout` or `transport`.
    """

    def __init__(self, url: str = ADDRESS, *, patience_s: float = PATIENCE_S, **options: Any) -> None:
        self._http = httpx.Client(base_url=url, **OPTIONS | options)
        self._patience_s = patience_s

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the connections."""
        self._http.close()

    def solve(self, endpoint: str, request: Json) -> Json:
        """Post a request to an endpoint and return the answer. Raises `ProblemError` if the answer is a problem."""
        give_up = time.monotonic() + self._patience_s
        while True:
            with _connected():
                response = self._http.post(endpoint, json=request)
            if response.is_success:
                return _json_of(response)
            time.sleep(_wait_s(response, give_up))

    def study(self, endpoint: str, request: Json, *, progress: bool = False) -> Study:
        """Open a study. The study starts when its results are read."""
        return Study(self._http, endpoint, request, self._patience_s, progress=progress)

    def example(self, name: str) -> Json:
        """Return the request of a ready example.

        Parameters
        ----------
        name : str
            Name of the example.

        Returns
        -------
        dict
            Body of the request.
        """
        with _connected():
            return _request_of(self._http.get(f"/v1/examples/{name}"))


class AsyncTribodrive(_Endpoints[Awaitable[Json], AsyncStudy]):
    """A client of the service for programs that use asyncio. The parameters are those of `Tribodrive`."""

    def __init__(self, url: str = ADDRESS, *, patience_s: float = PATIENCE_S, **options: Any) -> None:
        self._http = httpx.AsyncClient(base_url=url, **OPTIONS | options)
        self._patience_s = patience_s

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.close()

    async def close(self) -> None:
        """Close the connections."""
        await self._http.aclose()

    async def solve(self, endpoint: str, request: Json) -> Json:
        """Post a request to an endpoint and return the answer. Raises `ProblemError` if the answer is a problem."""
        give_up = time.monotonic() + self._patience_s
        while True:
            with _connected():
                response = await self._http.post(endpoint, json=request)
            if response.is_success:
                return _json_of(response)
            await asyncio.sleep(_wait_s(response, give_up))

    def study(self, endpoint: str, request: Json, *, progress: bool = False) -> AsyncStudy:
        """Open a study. The study starts when its results are read."""
        return AsyncStudy(self._http, endpoint, request, self._patience_s, progress=progress)

    async def example(self, name: str) -> Json:
        """Return the request of a ready example.

        Parameters
        ----------
        name : str
            Name of the example.

        Returns
        -------
        dict
            Body of the request.
        """
        with _connected():
            return _request_of(await self._http.get(f"/v1/examples/{name}"))


@contextmanager
def _connected(kind: type[ServiceError] = ServiceError, what: str = "the connection failed") -> Iterator[None]:
    """Raise an error if the service cannot be reached, or if the connection breaks off."""
    try:
        yield
    except httpx.RequestError as error:
        raise kind(f"{what}: {str(error) or type(error).__name__}") from error


def _json_of(response: httpx.Response) -> Json:
    """Return the JSON object of an answer. Raises `ServiceError` if the answer is not a JSON object."""
    try:
        content = response.json()
    except (ValueError, RecursionError):
        content = None
    if not isinstance(content, dict):
        raise ServiceError(f"{response.status_code}: the answer is not a JSON object: {response.text[:100]}")
    return content


def _request_of(example: httpx.Response) -> Json:
    if not example.is_success:
        raise ProblemError(example)
    request = _json_of(example).get("request")
    if not isinstance(request, dict):
        raise ServiceError("the example has no request")
    return request


def _wait_s(response: httpx.Response, give_up: float) -> float:
    """Return the time [s] to wait before the client repeats a request that a busy service refused.

    Raises `ProblemError` if the answer has no `Retry-After`. Also raises `ProblemError` if the wait would end after
    `give_up`, a reading of the monotonic clock [s].
    """
    stated = response.headers.get("Retry-After", "")
    seconds = max(float(stated), LEAST_WAIT_S) if stated.isdecimal() else inf
    if time.monotonic() + seconds > give_up:
        raise ProblemError(response)
    return seconds
