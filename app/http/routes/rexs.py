"""Routes for gear units from REXS files: read a file, show it as a page, and send it back with results."""

from hashlib import sha256
from pathlib import PurePath
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
    """An uploaded file: its content, its name, which may be empty, and the request sent with the file."""

    content: bytes
    name: str = ""
    request: bytes | None = None


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
    state, upload = http.app.state, await _upload(http)
    unit = await state.pool.calculate(http, answer.unit_json, upload.content, state.settings.rexs_bytes)
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
    state, upload = http.app.state, await _upload(http)
    arguments = (upload.content, state.settings.rexs_bytes, stage, upload.request, state.settings.deadline_s)
    file: File = await state.pool.calculate(http, answer.with_results, *arguments)
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
        upload = await _upload(http)
        arguments = (upload.content, http.app.state.settings.rexs_bytes, upload.name)
        shown = await http.app.state.pool.calculate(http, answer.unit_html, root, *arguments)
    except Unprocessable as error:
        return problem_page(http, 422, "The file cannot be read", error.message)
    name = sha256(upload.content).hexdigest()
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


async def _upload(http: Request) -> Upload:
    """Return the file that the client sent, or raise the error that says why there is none."""
    media_type = http.headers.get("content-type", "").partition(";")[0].strip().lower()
    if media_type in TYPES:
        return Upload(await http.body())
    if media_type != FORM:
        raise HTTPException(415, f"send the file with the content type {', '.join(DOCUMENTED_TYPES)}, or as {FORM}")
    async with http.form(max_files=2, max_fields=2, max_part_size=http.app.state.settings.rexs_bytes) as form:
        parts = {name: await part.read() if not isinstance(part, str) else part.encode() for name, part in form.items()}
        name = getattr(form.get("file"), "filename", None) or ""
    if "file" not in parts:
        raise Unprocessable("missing", "the form needs a part with the name 'file'", "file")
    return Upload(parts["file"], PurePath(name).name[: REPORT_NAMES["rexs_file"]], parts.get("request") or None)
