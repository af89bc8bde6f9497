"""Routes for gear units from REXS files: read a file, show it as a page, and send it back with results."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from hashlib import file_digest
from io import BytesIO
from pathlib import PurePath
from shutil import copyfileobj
from tempfile import NamedTemporaryFile
from typing import Annotated, Any, NamedTuple

from fastapi import APIRouter, HTTPException, Query, Request, Response
from fastapi.responses import HTMLResponse, RedirectResponse

from app.errors import Unprocessable
from app.http.problems import documented
from app.http.routes.pages import html, problem_page, root_of
from app.pages.query import REPORT_NAMES
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
    summary="A gear unit's file (REXS) with the results of a stage in it",
    responses={200: {"description": "the file with results", "content": {"application/xml": {"schema": FILE}}}},
)
async def write_results(
    http: Request, stage: Annotated[int, Query(description="id of the stage's component")]
) -> Response:
    """Write the numerical results of a stage into the file.

    The results become attributes of the component that describes the stage. A result for which the standard has an
    attribute is written to this attribute. Any other result is written to an attribute whose name begins with
    `custom_tribodrive_`. The rest of the file is unchanged.
    """
    state = http.app.state
    async with _uploaded(http) as upload:
        limits = (state.settings.rexs_bytes, stage, upload.request, state.settings.deadline_s)
        file: File = await state.pool.calculate(http, answer.of_file, upload.path, answer.with_results, *limits)
    headers = {"Content-Disposition": f'attachment; filename="results{file.suffix}"'}
    return Response(file.content, media_type=file.media_type, headers=headers)


@pages.get("/rexs")
async def ask_for_unit(http: Request) -> Response:
    """Redirect to the field of the start page in which a file can be chosen."""
    return RedirectResponse(f"{root_of(http)}/#rexs-file", 303)


@pages.post("/rexs", response_class=HTMLResponse)
async def open_unit(http: Request) -> Response:
    """Read a file and redirect to the page of its gear unit.

    If the page is too large to keep, answer with the page itself. If the file cannot be read, answer with the reason.
    """
    root = root_of(http)
    try:
        async with _uploaded(http) as upload:
            arguments = (upload.path, answer.unit_html, root, http.app.state.settings.rexs_bytes, upload.name)
            shown = await http.app.state.pool.calculate(http, answer.of_file, *arguments)
    except Unprocessable as error:
        return problem_page(http, 422, "The file cannot be read", error.message)
    name = upload.sha256
    try:
        http.app.state.answers[_key(root, name)] = shown
    except ValueError:  # the page is larger than the space for kept pages
        return html(shown)
    return RedirectResponse(f"{root}/rexs/{name}", 303)


@pages.get("/rexs/{name}", response_class=HTMLResponse)
async def show_unit(http: Request, name: str) -> Response:
    """Show the page of a unit: its stages, findings and links. Answer 410 if the page is no longer kept."""
    shown = http.app.state.answers.get(_key(root_of(http), name))
    if shown is None:
        reason = "The service keeps such a page for a short time only. This page no longer exists; open the file again."
        return problem_page(http, 410, "The file has to be opened again", reason)
    return html(shown)


def _key(root: str, name: str) -> str:
    return f"unit {name} {root}"


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
