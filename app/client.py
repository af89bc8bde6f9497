"""A client of the service, for scripts and notebooks; it needs httpx alone.

    from app.client import Tribodrive

    service = Tribodrive("http://127.0.0.1:8000")
    answer = service.coupling({"coupling": {...}, "operation": {...}})
    table = service.sweep({"endpoint": "/v1/coupling", "request": {...}, "vary": [...]}).frame()

Requests and answers are the JSON of the interface, as dictionaries. `AsyncTribodrive` has the same methods to be
awaited. A request that the service is too busy for is sent again after the time that it names (`Retry-After`).
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

if TYPE_CHECKING:
    from pandas import DataFrame

Json = dict[str, Any]
Answer = TypeVar("Answer")
Stream = TypeVar("Stream")
Http = TypeVar("Http", bound=httpx.Client | httpx.AsyncClient)

ADDRESS = "http://127.0.0.1:8000"
OPTIONS: dict[str, Any] = {
    "timeout": 60.0,  # s: beyond the default deadline of a calculation, 30 s
    "limits": httpx.Limits(keepalive_expiry=3.0),  # s: the service closes idle connections after 5 s
}
PATIENCE_S = 120.0  # in all for an answer, chosen: four times the service's deadline
LEAST_WAIT_S = 0.25  # before a busy service is asked again, whatever it names; chosen


class ServiceError(Exception):
    """The service gave no answer: a problem, a study that ended early, or something that is not of its interface."""


class ProblemError(ServiceError):
    """An answer other than 200.

    Attributes
    ----------
    status
        HTTP status.
    code
        Stable name of the problem, the last part of its type.
    errors
        A dictionary per field at fault with `pointer` (JSON Pointer into the request), `code` and `message`.

    """

    def __init__(self, response: httpx.Response) -> None:
        try:
            document = _json_of(response)
        except ServiceError:  # of a proxy
            document = {}
        self.status = response.status_code
        self.code = str(document.get("type", "")).rpartition(":")[2]
        errors = document.get("errors")
        self.errors: list[Json] = (
            [each for each in errors if isinstance(each, dict)] if isinstance(errors, list) else []
        )
        faults = "; ".join(f"{each.get('pointer') or 'request'}: {each.get('message', '')}" for each in self.errors)
        super().__init__(f"{self.status} {self.code}: {faults or document.get('detail', '')}")


class StudyError(ServiceError):
    """A study that ended before its last line: by its deadline, in the service, or with its connection."""


class _Endpoints(ABC, Generic[Answer, Stream]):
    """One method an endpoint; `request` is the body of the interface."""

    @abstractmethod
    def solve(self, endpoint: str, request: Json) -> Answer:
        """Post a request to an endpoint and return its answer; raises `ProblemError`."""

    @abstractmethod
    def study(self, endpoint: str, request: Json, *, progress: bool = False) -> Stream:
        """Open a study, which runs while its lines are read."""

    def coupling(self, request: Json) -> Answer:
        """Load, lubrication, friction, axial thrust and losses of a gear coupling."""
        return self.solve("/v1/coupling", request)

    def sleeve_orbit(self, request: Json) -> Answer:
        """Path and inertia force of a floating sleeve."""
        return self.solve("/v1/coupling/sleeve-orbit", request)

    def recommendation(self, request: Json) -> Answer:
        """The crowning with the best film over a range of misalignment."""
        return self.solve("/v1/coupling/recommendation", request)

    def pumping(self, request: Json) -> Answer:
        """Air and mist pumped between the teeth."""
        return self.solve("/v1/pumping", request)

    def choking_speed(self, request: Json) -> Answer:
        """Speeds at which the flow out of the tooth spaces becomes sonic."""
        return self.solve("/v1/pumping/choking-speed", request)

    def load_distribution(self, request: Json) -> Answer:
        """Load, pressure, transmission error and loss of a modified gear pair."""
        return self.solve("/v1/scuffing/load-distribution", request)

    def scuffing(self, request: Json) -> Answer:
        """Flash temperature, film thickness and safety factor against scuffing of a gear pair."""
        return self.solve("/v1/scuffing", request)

    def line_contact(self, request: Json) -> Answer:
        """One thermal elastohydrodynamic line contact."""
        return self.solve("/v1/scuffing/line-contact", request)

    def drive_train(self, request: Json) -> Answer:
        """A complete gear unit: couplings, shafts, bearings, mesh."""
        return self.solve("/v1/drive-train", request)

    def warm_up(self, request: Json) -> Answer:
        """How a gear unit warms up: temperatures over time, load and safety meanwhile."""
        return self.solve("/v1/drive-train/warm-up", request)

    def sweep(self, request: Json, *, progress: bool = False) -> Stream:
        """One endpoint at many points: a grid, a list of cases or a random sample."""
        return self.study("/v1/sweep", request, progress=progress)

    def spectrum(self, request: Json, *, progress: bool = False) -> Stream:
        """A machine with its tolerances over its load spectrum; the probabilities are in the last line."""
        return self.study("/v1/spectrum", request, progress=progress)

    def sensitivity(self, request: Json, *, progress: bool = False) -> Stream:
        """Which input moves each output most."""
        return self.study("/v1/sensitivity", request, progress=progress)

    def corners(self, request: Json, *, progress: bool = False) -> Stream:
        """A gear unit at every combination of its uncertain inputs."""
        return self.study("/v1/drive-train/corners", request, progress=progress)

    def design(self, request: Json, *, progress: bool = False) -> Stream:
        """The correction of a gear unit whose worst corner is best."""
        return self.study("/v1/drive-train/design", request, progress=progress)


class _Study(Generic[Http]):
    """The lines of a study sorted into header, results, progress and end."""

    def __init__(self, http: Http, endpoint: str, request: Json, patience_s: float, *, progress: bool) -> None:
        self.header: Json = {}
        self.end: Json = {}
        self._http = http
        self._endpoint = endpoint
        self._request = request
        self._patience_s = patience_s
        self._progress = progress
        self._bar: Any = None

    def _begin(self) -> float:
        """Begin anew; when to give up if the service is busy."""
        self.header, self.end = {}, {}
        if self._progress:
            from tqdm.auto import tqdm  # noqa: PLC0415  only who asks for a bar needs it

            self._bar = tqdm()
        return time.monotonic() + self._patience_s

    def _results(self, text: str) -> Iterator[Json]:
        """The line, if it is a result; raises `StudyError` for one that ends the study early or is none of a study."""
        try:
            yield from self._sorted(json.loads(text))
        except (ValueError, LookupError, TypeError) as error:
            raise StudyError(f"the service sent a line that is none of a study: {text[:100]}") from error

    def _sorted(self, line: Json) -> Iterator[Json]:
        match line["type"]:
            case "error":
                raise StudyError(f"{line['code']}: {line['message']}")
            case "progress":
                self._show(line["done"], line["total"])
            case "end":
                self.end = line
                if total := self.header.get("total"):
                    self._show(total, total)
            case _ if "case" in line and "outputs" in line:
                self.header = line
            case kind:
                if kind == "point":
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
            raise StudyError("the connection was closed before the study's end")

    def _table(self, results: list[Json]) -> "DataFrame":
        from pandas import DataFrame, json_normalize  # noqa: PLC0415  only tables need it

        if not results:
            return json_normalize(self.end.get("cases", []))
        if "axes" not in self.header:
            return DataFrame(results)
        points = [line for line in results if line["type"] == "point"]
        columns = [each["path"] for each in self.header["axes"] + self.header["outputs"]]
        rows = [[*line["at"], *line["out"], line["status"]] for line in points]
        return DataFrame(rows, columns=[*columns, "status"], index=[line["index"] for line in points])


class Study(_Study[httpx.Client]):
    """A study: iterate over its results, or ask for all of them as a table.

    `header` and `end` are its first and last line once they have been read; they are empty before.
    """

    def __iter__(self) -> Iterator[Json]:
        """Run the study and yield its results as they come; raises `ProblemError` and `StudyError`."""
        give_up = self._begin()
        while True:
            with self._http.stream("POST", self._endpoint, json=self._request) as response:
                if response.is_success:
                    with _whole():
                        for text in response.iter_lines():
                            yield from self._results(text)
                    return self._finish()
                response.read()
            time.sleep(_wait_s(response, give_up))

    def frame(self) -> "DataFrame":
        """All results as a pandas table, a row each; those of a sweep with a column for each input and output.

        A spectrum has a row for each case, unless its points are asked for.
        """
        return self._table(list(self))


class AsyncStudy(_Study[httpx.AsyncClient]):
    """A study: iterate over its results with `async for`, or await all of them as a table."""

    async def __aiter__(self) -> AsyncIterator[Json]:
        """Run the study and yield its results as they come; raises `ProblemError` and `StudyError`."""
        give_up = self._begin()
        while True:
            async with self._http.stream("POST", self._endpoint, json=self._request) as response:
                if response.is_success:
                    with _whole():
                        async for text in response.aiter_lines():
                            for line in self._results(text):
                                yield line
                    self._finish()
                    return
                await response.aread()
            await asyncio.sleep(_wait_s(response, give_up))

    async def frame(self) -> "DataFrame":
        """All results as a pandas table, a row each, as `Study.frame` gives them."""
        return self._table([line async for line in self])


class Tribodrive(_Endpoints[Json, Study]):
    """The service at `url`.

    Parameters
    ----------
    url
        Address of the service, with its path prefix if it has one.
    patience_s
        How long a request is sent again while the service is busy or warming up [s].
    options
        Of `httpx.Client`: `auth`, `headers`, `verify`, `timeout`, `transport`.

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
        """Post a request to an endpoint and return its answer; raises `ProblemError`."""
        give_up = time.monotonic() + self._patience_s
        while True:
            response = self._http.post(endpoint, json=request)
            if response.is_success:
                return _json_of(response)
            time.sleep(_wait_s(response, give_up))

    def study(self, endpoint: str, request: Json, *, progress: bool = False) -> Study:
        """Open a study, which runs while its lines are read."""
        return Study(self._http, endpoint, request, self._patience_s, progress=progress)

    def example(self, name: str) -> Json:
        """The request of a ready example."""
        return _request_of(self._http.get(f"/v1/examples/{name}"))


class AsyncTribodrive(_Endpoints[Awaitable[Json], AsyncStudy]):
    """The service at `url` for asyncio; parameters as those of `Tribodrive`."""

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
        """Post a request to an endpoint and return its answer; raises `ProblemError`."""
        give_up = time.monotonic() + self._patience_s
        while True:
            response = await self._http.post(endpoint, json=request)
            if response.is_success:
                return _json_of(response)
            await asyncio.sleep(_wait_s(response, give_up))

    def study(self, endpoint: str, request: Json, *, progress: bool = False) -> AsyncStudy:
        """Open a study, which runs while its lines are read."""
        return AsyncStudy(self._http, endpoint, request, self._patience_s, progress=progress)

    async def example(self, name: str) -> Json:
        """The request of a ready example."""
        return _request_of(await self._http.get(f"/v1/examples/{name}"))


@contextmanager
def _whole() -> Iterator[None]:
    """Raise StudyError if the connection breaks off while lines are read."""
    try:
        yield
    except httpx.RequestError as error:
        raise StudyError(f"the connection was closed before the study's end: {error}") from error


def _json_of(response: httpx.Response) -> Json:
    """Return the JSON object of an answer; raises `ServiceError` if it is none."""
    try:
        content = response.json()
    except ValueError:
        content = None
    if not isinstance(content, dict):
        raise ServiceError(f"{response.status_code}: the answer is no JSON object: {response.text[:100]}")
    return content


def _request_of(example: httpx.Response) -> Json:
    if not example.is_success:
        raise ProblemError(example)
    request = _json_of(example).get("request")
    if not isinstance(request, dict):
        raise ServiceError("the example has no request")
    return request


def _wait_s(response: httpx.Response, give_up: float) -> float:
    """Seconds to wait before a busy service is asked again; raises `ProblemError` for every other answer."""
    named = response.headers.get("Retry-After", "")
    seconds = max(float(named), LEAST_WAIT_S) if named.isdecimal() else inf
    if time.monotonic() + seconds > give_up:
        raise ProblemError(response)
    return seconds
