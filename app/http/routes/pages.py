"""Start page and pages of cases. The addresses of all views of a case have the same query."""

import json
from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import replace
from http import HTTPStatus
from mimetypes import guess_type
from pathlib import PurePath
from typing import Any
from urllib.parse import quote

from fastapi import APIRouter, Request, Response
from fastapi.responses import HTMLResponse, RedirectResponse
from starlette.exceptions import HTTPException

from app.calculations import BY_PATH, CALCULATIONS, Calculation
from app.errors import Unreadable, kind_of
from app.figures import MEDIA_TYPES
from app.http.problems import answer
from app.pages import views
from app.pages.asked import asked_in
from app.pages.cases import Asked, key_of, opened
from app.pages.overview import new_pair_page, start_page
from app.pages.pair_report import others_of, report_of
from app.pages.query import link
from app.pages.templating import ASSETS, page_path, rendered
from app.sources import SHORT_SOURCES

PAGE_POLICY = "default-src 'self'; img-src 'self' data:; base-uri 'none'; form-action 'self'; frame-ancestors 'none'"
DOCUMENT_POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'self'; "
DOCUMENT_POLICY += "frame-ancestors 'none'"
HTML = "text/html; charset=utf-8"
JSON = "application/json"
FORM = "application/x-www-form-urlencoded"
FOREVER = "public, max-age=31536000, immutable"
METHODS = ["GET", "POST"]

router = APIRouter(include_in_schema=False)


@router.get("/")
async def start(http: Request) -> Response:
    """Show the start page."""
    return html(start_page(root_of(http)))


@router.get("/pair", response_class=HTMLResponse)
async def new_pair(http: Request) -> Response:
    """Show the form of a new gear pair."""
    return html(new_pair_page(root_of(http)))


@router.get("/static/{name}")
async def static(name: str) -> Response:
    """Send a style sheet, a script or the icon of the pages."""
    if name not in ASSETS:
        raise HTTPException(404, f"Available: {', '.join(ASSETS)}")
    return Response(ASSETS[name], media_type=guess_type(name)[0], headers={"Cache-Control": FOREVER})


@router.post("/case", response_class=HTMLResponse)
async def open_case(http: Request) -> Response:
    """Read a case from a file. Redirect to the page of the case; if the case is too long for a link, send the page."""
    if not http.headers.get("content-type", "").startswith("multipart/form-data"):
        raise HTTPException(415, "Send the file with the case as multipart/form-data")
    async with http.form(max_files=1, max_fields=0) as form:
        sent = form.get("file")
        if sent is None or isinstance(sent, str):
            raise Unreadable("The form needs a part with the name 'file'")
        asked = opened(await sent.read(), root_of(http))
    if not asked.too_long:
        return redirected(asked.path, asked)
    await http.app.state.start_up.wait(http, asked.calculation.kernels.of(dict(asked.pairs).get))
    found = await shown(http, asked, views.page)
    return html(found.content, found.status)


def _add(calculation: Calculation) -> None:
    path = page_path(calculation)
    names = [figure.name for figure in calculation.figures]

    @router.api_route(path, methods=METHODS, response_class=HTMLResponse)
    async def page(http: Request) -> Response:
        return await _answer(http, calculation, HTML, views.page)

    @router.api_route(f"{path}/report", methods=METHODS, response_class=HTMLResponse)
    async def report(http: Request) -> Response:
        return await _answer(http, calculation, HTML, report_of, printed_host(http), await _others(http, calculation))

    @router.api_route(f"{path}/result.{{media}}", methods=METHODS)
    async def result(http: Request, media: str) -> Response:
        types = {"json": JSON, "csv": MEDIA_TYPES["csv"]}
        if media not in types:
            raise HTTPException(404, "Available: result.json, result.csv")
        return await _answer(http, calculation, types[media], views.result, media)

    @router.api_route(f"{path}/case.json", methods=METHODS)
    async def saved(http: Request) -> Response:
        """Send a JSON file with the title, the endpoint, and the request as typed, which may be incomplete."""
        asked, _ = await asked_of(http, calculation)
        content = {"title": asked.title, "endpoint": calculation.path, "request": asked.body}
        name = "".join(sign for sign in asked.title if sign.isalnum() or sign in " -").strip() or PurePath(path).name
        disposition = f"attachment; filename*=UTF-8''{quote(name)}.json"
        headers = {"Content-Security-Policy": DOCUMENT_POLICY, "Content-Disposition": disposition}
        return Response(json.dumps(content, indent=1, ensure_ascii=False), media_type=JSON, headers=headers)

    for there in calculation.words.hands_on:
        _add_into(calculation, there)

    @router.api_route(f"{path}/figures/{{name}}.{{image_format}}", methods=METHODS)
    async def figure(http: Request, name: str, image_format: str) -> Response:
        kinds = MEDIA_TYPES | {"json": JSON}
        if name not in names or image_format not in kinds:
            raise unknown_figure(names, MEDIA_TYPES)
        media = kinds[image_format]
        if "case" in http.query_params:
            found = await shown(http, _kept(http, path), views.figure, name, image_format)
            return Response(found.content, media_type=media, headers={"Content-Security-Policy": DOCUMENT_POLICY})
        return await _answer(http, calculation, media, views.figure, name, image_format)


async def _others(http: Request, calculation: Calculation) -> list[Asked]:
    """Return the other cases of a report with their answers; every case is solved by its own call."""
    asked, _ = await asked_of(http, calculation)
    others = others_of(asked)
    return [await with_answer(http, each) for each in (asked, *others)][1:] if others else []


async def with_answer(http: Request, asked: Asked) -> Asked:
    """Return a case with its answer, which a worker makes unless the service still keeps it."""
    answers, key = http.app.state.answers, key_of(asked.path, asked.pairs)
    if (kept := answers.get(key)) is None:
        await http.app.state.start_up.wait(http, asked.calculation.kernels.of(dict(asked.pairs).get))
        found = await shown(http, asked, views.summary)
        kept = found.keep.get(key)
    return replace(asked, kept=kept)


def _add_into(calculation: Calculation, there: str) -> None:
    """Add the address that solves a case, and continues on the page of `there` with the result as an input."""

    @router.get(f"{page_path(calculation)}/into{page_path(BY_PATH[there])}", response_class=HTMLResponse)
    async def into(http: Request) -> Response:
        asked, _ = await asked_of(http, calculation)
        await http.app.state.start_up.wait(http, calculation.kernels.of(dict(asked.pairs).get))
        found = await shown(http, asked, views.handed_on, there)
        if found.status == HTTPStatus.SEE_OTHER:
            return RedirectResponse(root_of(http) + found.content.decode(), found.status)
        return html(found.content, found.status)


async def _answer(
    http: Request, calculation: Calculation, media: str, view: Callable[..., views.Shown], *arguments: Any
) -> Response:
    """Send a view of the case that the query or the form contains.

    If the query has empty fields, redirect to a query without these fields.
    """
    asked, clean = await asked_of(http, calculation)
    if not clean and http.scope["method"] == "GET" and (asked.pairs or not asked.pressed):
        return redirected(path_of(http), asked)
    if asked.pairs:
        await http.app.state.start_up.wait(http, calculation.kernels.of(dict(asked.pairs).get))
    found = await shown(http, asked, view, *arguments)
    policy = PAGE_POLICY if view is views.page else DOCUMENT_POLICY
    return Response(found.content, found.status, media_type=media, headers={"Content-Security-Policy": policy})


def redirected(place: str, asked: Asked) -> Response:
    """Redirect to the shortest address of the same case, with the hash of the solvers' sources."""
    looks = {**asked.views, "sources": asked.views.get("sources", SHORT_SOURCES)} if asked.pairs else asked.views
    return RedirectResponse(quote(asked.root + link(place, asked.pairs, **looks), safe="/?&=%,:.*+-_~"), 303)


async def asked_of(http: Request, calculation: Calculation) -> tuple[Asked, bool]:
    """Return the requested case, and True if the query is already in its shortest form, without empty fields."""
    text = http.url.query
    if http.scope["method"] == "POST":
        if http.headers.get("content-type", "").partition(";")[0].strip() != FORM:
            raise HTTPException(415, f"The content type must be {FORM}")
        text = (await http.body()).decode("ascii", "replace")
    return asked_in(calculation, text, root_of(http), http.app.state.answers)


def _kept(http: Request, path: str) -> Asked:
    """Return the case and the variant whose hashes are in the query. Answer 410 if one of them is no longer kept."""
    query, answers = http.query_params, http.app.state.answers
    kept, kept_ref = (answers.get(key_of(path, [("case", query.get(name, ""))])) for name in ("case", "ref_case"))
    if kept is None or (query.get("ref_case") and kept_ref is None):
        raise HTTPException(410, "The answer to this case is no longer stored; calculate the case again")
    looks = {name: query.get(name, "") for name in ("theme", "narrow")}
    return Asked(path, [], looks, kept, kept_ref)


async def shown(http: Request, asked: Asked, view: Callable[..., views.Shown], *arguments: Any) -> views.Shown:
    """Let a worker make a view of a case, and return the view.

    The service keeps the answers that the worker used, so that other views of the case can reuse these answers.
    """
    found: views.Shown = await http.app.state.pool.calculate(http, view, asked, *arguments)
    for key, content in found.keep.items():
        with suppress(ValueError):  # ValueError: the answer is larger than the space for all kept answers
            http.app.state.answers[key] = content
    return found


def failed(http: Request, error: Exception) -> Response:
    """Return an error as a page or as a problem document.

    The result is a page if the route sends pages, or if a browser asks for an unknown address.
    """
    if isinstance(error, HTTPException):
        if "text/html" not in http.headers.get("accept", "") or path_of(http).startswith("/v1/"):
            return answer(http, error)
        title = HTTPStatus(error.status_code).phrase
        detail = "There is nothing at this address." if error.detail == title else error.detail
        return problem_page(http, error.status_code, title, detail, dict(error.headers or {}))
    if getattr(http.scope.get("route"), "response_class", None) is not HTMLResponse:
        return answer(http, error)
    kind = kind_of(error)
    return problem_page(http, kind.status, kind.title, getattr(error, "detail", ""), kind.headers)


def problem_page(
    http: Request, status: int, title: str, detail: str, headers: dict[str, str] | None = None
) -> Response:
    """Return a page that states why a request was not answered.

    If the request sent a file, the page has a field for another file. If the service was busy, it can be asked again.
    """
    place = path_of(http).split("/")[1]
    again = http.method == "GET" and status in {HTTPStatus.SERVICE_UNAVAILABLE, HTTPStatus.GATEWAY_TIMEOUT}
    page = rendered("problem.html", root_of(http), title=title, detail=detail, place=place, again=again)
    return html(page, status, headers)


def unknown_figure(names: Iterable[str], formats: Iterable[str]) -> HTTPException:
    """Return the error for a figure or a format that does not exist."""
    available = f"The figures are {', '.join(names)}. The formats are {', '.join(formats)}"
    return HTTPException(404, f"This figure or this format does not exist. {available}")


def root_of(http: Request) -> str:
    """Return the prefix that a proxy puts before the addresses of the service."""
    root: str = http.scope.get("root_path", "")
    return root


def path_of(http: Request) -> str:
    """Return the address of a request without the prefix of a proxy."""
    path: str = http.scope["path"]
    return path.removeprefix(root_of(http))


def printed_host(http: Request) -> str:
    """Return scheme and host for printed reports, or an empty text if the host is not to be printed.

    The host comes from the request, so a client can state any host. Only the hosts in the settings and this computer
    are printed, because another host could lead the reader of a report to another service.
    """
    trusted = {*http.app.state.settings.hosts, "localhost", "127.0.0.1", "::1"}
    is_trusted = http.url.netloc in trusted or http.url.hostname in trusted
    return f"{http.url.scheme}://{http.url.netloc}" if is_trusted else ""


def html(content: str | bytes, status: int = 200, headers: dict[str, str] | None = None) -> Response:
    """Return a page with a strict content security policy."""
    policy = {"Content-Security-Policy": PAGE_POLICY}
    return Response(content, status, media_type=HTML, headers=policy | (headers or {}))


for row in CALCULATIONS:
    _add(row)
