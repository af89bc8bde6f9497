"""Endpoints of studies. A study solves a request at many points and sends its results as a stream."""

import asyncio
import inspect
from collections.abc import AsyncGenerator, Callable
from contextlib import ExitStack, aclosing
from functools import partial
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Body, Query, Request, Response
from fastapi.responses import StreamingResponse
from pydantic import BaseModel
from starlette.types import Receive, Scope, Send

from app.calculations import BY_PATH
from app.examples import study_bodies
from app.http.json_route import JsonRoute
from app.http.problems import documented
from app.http.streams import PROGRESS_S, encoded, guarded
from app.studies.kinds import KINDS
from app.studies.runner import Clock, Lines, Study

Format = Literal["ndjson", "csv"]
MEDIA_TYPES: dict[Format, str] = {"ndjson": "application/x-ndjson", "csv": "text/csv"}
READING_S = 10.0  # additional time after the deadline of the study for a client that reads slowly


class StudyStream(StreamingResponse):
    """A response that sends every result line of a study as soon as this line is computed.

    The study ends if the client leaves, or if the client has not read all lines within `seconds`.
    """

    def __init__(self, pieces: AsyncGenerator[bytes, None], seconds: float, stack: ExitStack, **options: Any) -> None:
        super().__init__(pieces, **options)
        self._pieces, self._seconds, self._stack = pieces, seconds, stack

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        with self._stack:
            async with aclosing(self._pieces), asyncio.timeout(self._seconds):
                await super().__call__(scope, receive, send)


async def planned(http: Request, planner: Callable[[int, float], Any], most: int) -> Any:
    """Run `planner` in a worker and return the result.

    The study may have at most `most` points. The planner must finish within the deadline of a calculation.
    """
    return await http.app.state.pool.calculate(http, planner, most, http.app.state.settings.deadline_s)


async def begun(http: Request, study: Study, progress_s: float = PROGRESS_S) -> tuple[Lines, Clock]:
    """Begin a study that already counts as running. Return its results, as they come, and its clock."""
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
    """Return a response that streams a study's results. The study counts as running until the response ends."""
    with ExitStack() as stack:
        stack.enter_context(http.app.state.studies.place())
        content = pieces(*await begun(http, study, progress_s))
        seconds = http.app.state.settings.study_deadline_s + READING_S
        headers = {"X-Accel-Buffering": "no"} | (headers or {})
        return StudyStream(content, seconds, stack.pop_all(), media_type=media_type, headers=headers)


async def started(http: Request, kind: type[Study], body: BaseModel, written_as: Format = "ndjson") -> Response:
    """Check a study in a worker, then return a response that streams the results of the study."""
    study: Study = await planned(http, partial(kind, body), getattr(http.app.state.settings, kind.most))
    await http.app.state.start_up.wait(http, BY_PATH[study.question.endpoint].kernels.of())
    encode = study.encoder(written_as)
    return await streamed(http, study, lambda lines, _: encoded(lines, encode), MEDIA_TYPES[written_as])


def wanted_format(http: Request, named: Format) -> Format:
    """Return the format in the query, else the first format that the client accepts, else NDJSON."""
    if "format" in http.query_params:
        return named
    accepted = [part.partition(";")[0].strip().lower() for part in http.headers.get("accept", "").split(",")]
    return next((name for media in accepted for name, own in MEDIA_TYPES.items() if media == own), "ndjson")


router = APIRouter(tags=["studies"], route_class=JsonRoute, responses=documented(400, 413, 415, 422, 500, 503, 504))


def _add(kind: type[Study]) -> None:
    """Add the endpoint of a kind of study. If the lines of the study can be a table, add a choice of formats."""

    async def lines(http: Request, body: Any) -> Response:
        return await started(http, kind, body)

    async def lines_or_table(
        http: Request,
        body: Any,
        written_as: Annotated[
            Format, Query(alias="format", description="JSON a line, or a table; the Accept header can choose it too")
        ] = "ndjson",
    ) -> Response:
        return await started(http, kind, body, wanted_format(http, written_as))

    answer = lines_or_table if "csv" in kind.formats else lines
    answer.__annotations__["body"] = Annotated[kind.model, Body(openapi_examples=study_bodies(kind.path) or None)]
    content = {media: {"schema": {"type": "string"}} for name, media in MEDIA_TYPES.items() if name in kind.formats}
    router.add_api_route(
        kind.path,
        answer,
        methods=["POST"],
        operation_id=kind.path.removeprefix("/v1/").replace("/", "_").replace("-", "_"),
        summary=kind.summary,
        description=inspect.getdoc(kind),
        response_class=Response,
        responses={200: {"description": kind.answer, "content": content}},
    )


for each in KINDS:
    _add(each)
