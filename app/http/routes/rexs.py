"""Routes for gear units from REXS files: read a file, show it as a page, and send it back with results.

A file and its unit are kept in memory for a while, so that its page can calculate all stages and write them back.
"""

import json
import zlib
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from dataclasses import replace
from hashlib import file_digest
from io import BytesIO
from pathlib import PurePath
from shutil import copyfileobj
from tempfile import NamedTemporaryFile
from typing import Annotated, Any, NamedTuple
from urllib.parse import quote

from fastapi import APIRouter, HTTPException, Query, Request, Response
from fastapi.responses import HTMLResponse, RedirectResponse

from app.errors import Unprocessable
from app.http.problems import documented
from app.http.routes.pages import html, problem_page, root_of, shown
from app.pages import views
from app.pages.cases import Asked, key_of
from app.pages.overview import common_of
from app.pages.query import REPORT_NAMES, WRITTEN, Pairs, link
from app.pages.views import Shown
from app.rexs import answer
from app.rexs.document import File

DOCUMENTED_TYPES = ("application/xml", "application/json", "application/zip")
TYPES = (*DOCUMENTED_TYPES, "text/xml", "application/x-zip-compressed", "application/octet-stream")
FORM = "multipart/form-data"
FILE = {"type": "string", "format": "binary"}


def _body(types: tuple[str, ...], **form: dict[str, str]) -> dict[str, Any]:
    """Describe the body of an operation: a file of one of the `types`, or a form with the file and other fields."""
    properties = {"file": FILE, **form}
    schema = {"type": "object", "required": ["file"], "additionalProperties": False, "properties": properties}
    content = {**{media_type: {"schema": FILE} for media_type in types}, FORM: {"schema": schema}}
    return {"requestBody": {"required": True, "content": content}}


UPLOAD = _body(DOCUMENTED_TYPES)
UPLOAD_WITH_REQUEST = _body((), request={"type": "string", "description": "the stage's request as edited, JSON"})


class Upload(NamedTuple):
    """An uploaded file on disk: its path, its name, which may be empty, its hash, and the request sent with it."""

    path: str
    name: str
    sha256: str
    request: bytes | None


router = APIRouter(tags=["files"], responses=documented(400, 413, 415, 422, 500, 503, 504))
pages = APIRouter(include_in_schema=False)


@router.post(
    answer.PATH,
    response_model=answer.GearUnit,
    openapi_extra=UPLOAD,
    operation_id="rexs",
    summary="The stages of a gear unit's file (REXS) as ready requests",
)
async def read_unit(http: Request) -> Response:
    """Read a file and return the stages of its gear unit as requests that are ready to send.

    The answer also lists the values that are missing, assumed, unused or wrong.
    """
    state = http.app.state
    async with _uploaded(http) as upload:
        arguments = (upload.path, answer.unit_json, state.settings.rexs_bytes)
        unit = await state.pool.calculate(http, answer.of_file, *arguments)
    return Response(unit, media_type="application/json")


@router.post(
    f"{answer.PATH}/results",
    response_class=Response,
    openapi_extra=UPLOAD_WITH_REQUEST,
    operation_id="rexs_results",
    summary="A gear unit's file (REXS) with the results of a stage, or of all stages, in it",
    responses={200: {"description": "the file with results", "content": {"application/xml": {"schema": FILE}}}},
)
async def write_results(
    http: Request,
    stage: Annotated[int | None, Query(description="id of the stage's component; without it, all stages")] = None,
) -> Response:
    """Write the numerical results of a stage, or of all stages, into the file.

    The results become attributes of the component that describes the stage. A result for which the standard has an
    attribute is written to this attribute. Any other result is written to an attribute whose name begins with
    `custom_tribodrive_`. The rest of the file is unchanged, with its name, its declaration and its line ends. Of all
    stages, one that cannot be calculated gets the reason as its status.
    """
    state = http.app.state
    async with _uploaded(http) as upload:
        if stage is not None:
            limits = (state.settings.rexs_bytes, stage, upload.request, state.settings.deadline_s)
            file: File = await state.pool.calculate(http, answer.of_file, upload.path, answer.with_results, *limits)
            return _download(file, upload.name)
        if upload.request is not None:
            raise Unprocessable("missing", "the part 'request' belongs to one stage; give its id as `stage`", "stage")
        unit = await state.pool.calculate(
            http, answer.of_file, upload.path, answer.unit_json, state.settings.rexs_bytes
        )
        solved = await _solved(http, unit, [])
        limits_of_all = (state.settings.rexs_bytes, [(stages, asked) for stages, asked, _ in solved])
        file = await state.pool.calculate(http, answer.of_file, upload.path, answer.with_all_results, *limits_of_all)
        return _download(file, upload.name)


def _download(file: File, name: str) -> Response:
    """Send a file under the name that it had."""
    disposition = f"attachment; filename*=UTF-8''{quote(name or 'results' + file.suffix)}"
    return Response(file.content, media_type=file.media_type, headers={"Content-Disposition": disposition})


async def _solved(http: Request, unit: bytes, common: Pairs) -> list[tuple[list[int], Asked, dict[str, Any]]]:
    """Calculate all stages of a unit one after another: ids in the file, case with its answer, and summary."""
    state = http.app.state
    cases = await state.pool.calculate(http, answer.cases_of, unit, common)
    solved = []
    for stages, asked in cases:
        key = key_of(asked.path, asked.pairs)
        await state.start_up.wait(http, asked.calculation.kernels.of(dict(asked.pairs).get))
        found: Shown = await shown(http, replace(asked, kept=state.answers.get(key)), views.summary)
        kept = found.keep.get(key) or state.answers.get(key)
        solved.append((stages, replace(asked, kept=kept), json.loads(found.content)))
    return solved


@pages.get("/rexs")
async def ask_for_unit(http: Request) -> Response:
    """Redirect to the field of the start page in which a file can be chosen."""
    return RedirectResponse(f"{root_of(http)}/#rexs-file", 303)


@pages.post("/rexs", response_class=HTMLResponse)
async def open_unit(http: Request) -> Response:
    """Read a file and redirect to the page of its gear unit.

    If the unit is too large to keep, answer with the page itself. If the file cannot be read, answer with the reason.
    """
    root, state = root_of(http), http.app.state
    try:
        async with _uploaded(http) as upload:
            arguments = (upload.path, answer.unit_json, state.settings.rexs_bytes)
            unit: bytes = await state.pool.calculate(http, answer.of_file, *arguments)
            content: bytes = await state.pool.calculate(http, answer.of_file, upload.path, zlib.compress)
    except Unprocessable as error:
        return problem_page(http, 422, "The file cannot be read", error.message)
    sha256 = upload.sha256
    try:
        state.answers[_key("unit", sha256)] = upload.name.encode() + b"\0" + unit
    except ValueError:  # the unit is larger than the space for all that is kept
        return html(await state.pool.calculate(http, answer.unit_html, unit, root, upload.name, sha256))
    with suppress(ValueError):
        state.answers[_key("file", sha256)] = content
    return RedirectResponse(f"{root}/rexs/{sha256}", 303)


@pages.get("/rexs/{sha256}", response_class=HTMLResponse)
async def show_unit(http: Request, sha256: str) -> Response:
    """Show the page of a unit: stages, findings and links; the results of all stages, if the query asks for them.

    Answer 410 if the unit is no longer kept.
    """
    if (kept := _kept(http, sha256)) is None:
        return _gone(http)
    name, unit = kept
    common, asks = common_of(http.url.query), "all" in http.query_params
    if WRITTEN in http.query_params:
        views_of = {"all": "on"} if asks else {}
        return RedirectResponse(root_of(http) + link(f"/rexs/{sha256}", common, **views_of), 303)
    results = [summary for *_, summary in await _solved(http, unit, common)] if asks else []
    is_kept = _key("file", sha256) in http.app.state.answers
    arguments = (unit, root_of(http), name, sha256, common, results, is_kept)
    return html(await http.app.state.pool.calculate(http, answer.unit_html, *arguments))


@pages.post("/rexs/{sha256}/results", response_class=HTMLResponse)
async def write_all(http: Request, sha256: str) -> Response:
    """Send the file with the results of all stages; answer 410 if the file is no longer kept."""
    kept, packed = _kept(http, sha256), http.app.state.answers.get(_key("file", sha256))
    if kept is None or packed is None:
        return _gone(http)
    name, unit = kept
    solved = await _solved(http, unit, common_of(http.url.query))
    cases = [(stages, asked) for stages, asked, _ in solved]
    arguments = (zlib.decompress(packed), http.app.state.settings.rexs_bytes, cases)
    try:
        return _download(await http.app.state.pool.calculate(http, answer.with_all_results, *arguments), name)
    except Unprocessable as error:
        return problem_page(http, 422, "Nothing can be written", error.message)


def _kept(http: Request, sha256: str) -> tuple[str, bytes] | None:
    """Return the name of a unit's file and the unit as JSON, if they are still kept."""
    kept: bytes | None = http.app.state.answers.get(_key("unit", sha256))
    if kept is None:
        return None
    name, _, unit = kept.rpartition(b"\0")  # JSON contains no NUL, but a name may
    return name.decode(), unit


def _gone(http: Request) -> Response:
    reason = "The service keeps such a page for a short time only. This page no longer exists; open the file again."
    return problem_page(http, 410, "The file has to be opened again", reason)


def _key(kind: str, sha256: str) -> str:
    return f"{kind} {sha256}"


@asynccontextmanager
async def _uploaded(http: Request) -> AsyncIterator[Upload]:
    """Write the file that the client sends to disk, so that waiting files take no memory; delete it afterwards.

    Raises the error that says why there is no file.
    """
    media_type = http.headers.get("content-type", "").partition(";")[0].strip().lower()
    if media_type not in (*TYPES, FORM):
        raise HTTPException(415, f"send the file with the content type {', '.join(DOCUMENTED_TYPES)}, or as {FORM}")
    with NamedTemporaryFile(prefix="tribodrive-") as file:
        name, request = "", None
        if media_type != FORM:
            async for piece in http.stream():
                file.write(piece)
        else:
            most_bytes = http.app.state.settings.rexs_bytes
            async with http.form(max_files=2, max_fields=2, max_part_size=most_bytes) as form:
                if (sent := form.get("file")) is None:
                    raise Unprocessable("missing", "the form needs a part with the name 'file'", "file")
                copyfileobj(BytesIO(sent.encode()) if isinstance(sent, str) else sent.file, file)
                name = PurePath(getattr(sent, "filename", None) or "").name[: REPORT_NAMES["rexs_file"]]
                edited = form.get("request")
                request = edited.encode() if isinstance(edited, str) else await edited.read() if edited else None
        file.seek(0)
        yield Upload(file.name, name, file_digest(file, "sha256").hexdigest(), request or None)
