"""Studies: one request at many points, answered as a stream."""

import asyncio
from collections.abc import AsyncGenerator, Callable, Coroutine
from contextlib import ExitStack, aclosing
from functools import partial
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Body, Query, Request, Response
from fastapi.responses import StreamingResponse
from pydantic import BaseModel
from starlette.types import Receive, Scope, Send

from app.http.json_route import JsonRoute
from app.http.problems import documented
from app.settings import Settings
from app.studies import design, requests, sensitivity, spectrum, sweep
from app.studies.engine import PROGRESS_S, Clock, Line, Lines, Study, encoded, guarded, json_line

Format = Literal["ndjson", "csv"]
MEDIA_TYPES: dict[Format, str] = {"ndjson": "application/x-ndjson", "csv": "text/csv"}
Handler = Callable[..., Coroutine[Any, Any, Response]]
READING_S = 10.0  # beyond the study's deadline, for a client that reads slowly


class StudyStream(StreamingResponse):
    """Lines as they come; when the client leaves, or has not read all after so many seconds, the study ends."""

    def __init__(
        self,
        pieces: AsyncGenerator[bytes, None],
        media_type: str,
        seconds: float,
        stack: ExitStack,
        headers: dict[str, str] | None = None,
    ) -> None:
        super().__init__(pieces, media_type=media_type, headers={"X-Accel-Buffering": "no"} | (headers or {}))
        self._pieces, self._seconds, self._stack = pieces, seconds, stack

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Send everything."""
        with self._stack:
            async with aclosing(self._pieces), asyncio.timeout(self._seconds):
                await super().__call__(scope, receive, send)


async def planned(http: Request, planner: Callable[[int, float], Any], most: int | None = None) -> Any:
    """The result of `planner` in a worker, for at most `most` points with the service's deadline each."""
    limits: Settings = http.app.state.settings
    return await http.app.state.pool.calculate(http, planner, most or limits.most_study_points, limits.deadline_s)


async def begun(http: Request, study: Study, progress_s: float = PROGRESS_S) -> tuple[Lines, Clock]:
    """The lines of a study that counts among the running ones, and its clock."""
    clock = Clock(study.total)
    lines = study.lines(await http.app.state.studies.pool(), clock)
    return guarded(lines, clock, http.app.state.settings.study_deadline_s, progress_s), clock


async def streamed(
    http: Request,
    study: Study,
    pieces: Callable[[Lines, Clock], AsyncGenerator[bytes, None]],
    media_type: str,
    headers: dict[str, str] | None = None,
    progress_s: float = PROGRESS_S,
) -> Response:
    """The response made of the lines of a study, which counts among the running ones until it ends."""
    with ExitStack() as stack:
        stack.enter_context(http.app.state.studies.place())
        content = pieces(*await begun(http, study, progress_s))
        seconds = http.app.state.settings.study_deadline_s + READING_S
        return StudyStream(content, media_type, seconds, stack.pop_all(), headers)


async def started(
    http: Request,
    planner: Callable[[Any, int, float], Study],
    body: BaseModel,
    written_as: Format = "ndjson",
    most: int | None = None,
) -> Response:
    """The stream of a study of at most `most` points, which is checked in a worker before the first line."""
    http.app.state.start_up.require()
    study: Study = await planned(http, partial(planner, body), most)
    http.app.state.start_up.require(study.question.endpoint)
    encode = encoder(study, written_as)
    return await streamed(http, study, lambda lines, _: encoded(lines, encode), MEDIA_TYPES[written_as])


def encoder(study: Study, written_as: str) -> Callable[[Line], bytes]:
    """Writes the lines of a study; those of a sweep also as the rows of a table."""
    if isinstance(study, sweep.Sweep) and written_as == "csv":
        return partial(sweep.table_row, study.points, study.outputs)
    return json_line


def wanted_format(http: Request, named: Format) -> Format:
    """By `format` in the query, else the first that the client accepts, else NDJSON."""
    if "format" in http.query_params:
        return named
    accepted = [part.partition(";")[0].strip().lower() for part in http.headers.get("accept", "").split(",")]
    return next((name for media in accepted for name, own in MEDIA_TYPES.items() if media == own), "ndjson")


router = APIRouter(
    tags=["studies"], route_class=JsonRoute, responses=documented(400, 408, 413, 415, 422, 431, 500, 503, 504)
)


def _study(
    path: str, name: str, summary: str, lines: str, formats: tuple[Format, ...] = ("ndjson",)
) -> Callable[[Handler], Handler]:
    """The route of a study that answers these `lines`."""
    content = {MEDIA_TYPES[each]: {"schema": {"type": "string"}} for each in formats}
    return router.post(
        path,
        operation_id=name,
        summary=summary,
        response_class=Response,
        responses={200: {"description": lines, "content": content}},
    )


def _examples(path: str) -> Any:
    """The body parameter of a study, with its examples on the docs page."""
    return Body(openapi_examples=requests.EXAMPLES[path])


@_study(
    sweep.PATH,
    "sweep",
    "One request at many points: a grid, a list of cases, a random sample",
    "a line for the sweep, one for each point in order, one for the end",
    ("ndjson", "csv"),
)
async def run_sweep(
    http: Request,
    body: Annotated[requests.SweepRequest, _examples(sweep.PATH)],
    written_as: Annotated[
        Format, Query(alias="format", description="JSON a line, or a table; the Accept header can choose it too")
    ] = "ndjson",
) -> Response:
    """Every point is the endpoint's own answer.

    Lines are `sweep`, then `point` in order with the first axis slowest, `progress` when nothing else was sent for two
    seconds, and `end`; or `error`, which ends a study early and is the last row of a table. A stream without either was
    cut off: with `from_index` the study goes on, with the same points and lines from there.
    The end of a sample has the 5, 50 and 95 % quantiles, and in `quantile_bounds` their 90 % confidence intervals.
    """
    return await started(http, sweep.sweep_study, body, wanted_format(http, written_as))


@_study(
    sensitivity.PATH,
    "sensitivity",
    "What moves each output most",
    "a line for each output and input, the most influential first, and one for the end",
)
async def run_sensitivity(
    http: Request, body: Annotated[requests.SensitivityRequest, _examples(sensitivity.PATH)]
) -> Response:
    """Derivatives of the outputs by every number of the case, from differences with its tolerance as step.

    A field without a tolerance is moved by 1 %, a temperature by 1 K, an integer by 1.

    `change` is what one step does to the output, `elasticity` per cent of the output for a per cent of the input;
    `kink` says that the two sides differ by more than 10 %, `curved` that half the step gives another derivative by
    more than 10 %; it is null for fields without a tolerance.
    """
    return await started(http, sensitivity.sensitivity_study, body)


@_study(
    spectrum.PATH,
    "spectrum",
    "A machine with its tolerances over its load spectrum: probabilities, losses, what decides",
    "a line for the spectrum, one for each point if asked for, and one for the end",
)
async def run_spectrum(http: Request, body: Annotated[requests.SpectrumRequest, _examples(spectrum.PATH)]) -> Response:
    """Machines are drawn from the tolerances; each runs every case, and its worst case is compared with the limits.

    The last line has the probability of exceeding each limit with its 90 % interval, for the spectrum and for each case
    alone; how often each case is the worst (`decides`); the rank correlation with each tolerance; and of every output
    the mean over the operating time, the extremes, and the 5, 50 and 95 % quantiles in each case. Draws without
    solution are counted: where there are any, the probability is only known between its `bounds`. Where no output needs
    the thermal film, it is not calculated. Lines of `progress` come every half second.
    """
    return await started(http, spectrum.spectrum_study, body, most=http.app.state.settings.spectrum_solves)


@_study(
    sweep.CORNERS_PATH,
    "drive_train_corners",
    "A gear unit at every combination of its uncertain inputs",
    "a line for the ranges, each corner, the extremes of each output, and one for the end",
)
async def run_corners(
    http: Request, body: Annotated[requests.CornersRequest, _examples(sweep.CORNERS_PATH)]
) -> Response:
    """Every corner is the endpoint's own answer, up to 256 of them; `extremes` are the least and largest values.

    Where no output needs the thermal film, it is not calculated: corners are twenty times as fast and have fewer
    warnings. The last line warns `no_convergence_of_corner` where corners have no solution; their own lines say why.
    """
    return await started(http, sweep.corners_study, body)


@_study(
    design.PATH,
    "drive_train_design",
    "The correction of a gear unit that is best at its worst corner",
    "a line for the search, one for each correction tried, and one for the end",
)
async def run_design(http: Request, body: Annotated[requests.DesignRequest, _examples(design.PATH)]) -> Response:
    """A search with COBYQA that starts from the request's own correction.

    The objective of a correction is its value at the worst operating point and corner. `safety.minimum` needs the
    thermal film, a second a corner; with `safety.blok_flank`, or `model.lubrication` in closed form, the search is
    twenty times as fast. Where variables have a `step`, `rounded` in the last line is the best correction in whole
    steps, calculated like the others.
    """
    return await started(http, design.design_study, body)
