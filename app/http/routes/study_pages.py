"""Pages of studies, and their files. A page is sent piece by piece while the results of its study arrive."""

import asyncio
from collections.abc import Callable
from contextlib import aclosing
from functools import partial
from typing import Any

from fastapi import APIRouter, Depends, HTTPException, Request, Response
from fastapi.responses import HTMLResponse

from app import figures
from app.calculations import CALCULATIONS, Calculation
from app.errors import StudyEnded
from app.http.routes import pages
from app.http.routes.studies import MEDIA_TYPES, begun, planned, streamed
from app.http.streams import encoded
from app.pages.cases import Asked
from app.pages.studies import PAGES
from app.pages.studies import page as study_page
from app.pages.studies.page import StudyPage
from app.pages.studies.stream import pieces, report_pieces
from app.pages.study_links import study_links
from app.pages.templating import page_path
from app.studies.runner import twice_if_lost
from app.workers.pool import unless_gone

LINE_TYPES = {str(name): media for name, media in MEDIA_TYPES.items()}
IMAGE_TYPES = {str(name): media for name, media in figures.MEDIA_TYPES.items()}
PROGRESS_S = 0.5  # if a study has no line for this time, its progress is reported


def not_from_another_site(http: Request) -> None:
    """Answer 403 if a page of another site asks for a study, because a study occupies all cores for minutes."""
    asks = http.url.query or http.method == "POST"
    if asks and http.headers.get("sec-fetch-site") == "cross-site":
        raise HTTPException(403, "A page of another web site cannot start a study; open the study's address directly")


router = APIRouter(include_in_schema=False, dependencies=[Depends(not_from_another_site)])


def _add(calculation: Calculation, own: type[StudyPage]) -> None:
    """Add the page of a kind of study to a calculation. The page has results, figures and a report."""
    path = f"{page_path(calculation)}/{own.link.name}"
    policy = {"Content-Security-Policy": pages.DOCUMENT_POLICY}

    async def page(http: Request) -> Response:
        """Send the page as a stream, or as a whole if there is nothing to calculate."""
        asked, clean = await pages.asked_of(http, calculation)
        if not clean and http.scope["method"] == "GET":
            return pages.redirected(path, asked)
        opened: study_page.Opened = await _planned(http, own, asked, study_page.opened)
        if opened.page.study is None:
            return pages.html(opened.head + opened.tail, opened.status)
        headers = {"Content-Security-Policy": pages.PAGE_POLICY}
        parts = partial(pieces, http.app.state.studies.own, opened)
        return await streamed(http, opened.page.study, parts, pages.HTML, headers, PROGRESS_S)

    async def lines(http: Request, media: str) -> Response:
        if media not in own.plan.formats:
            names = ", ".join(f"{own.link.name}.{suffix}" for suffix in own.plan.formats)
            raise HTTPException(404, f"This file does not exist. The files are {names}")
        study = (await checked(http)).study
        encode = study.encoder(media)
        return await streamed(http, study, lambda found, _: encoded(found, encode), LINE_TYPES[media], policy)

    async def figure(http: Request, name: str, image_format: str) -> Response:
        if name not in own.figures or image_format not in IMAGE_TYPES:
            raise pages.unknown_figure(own.figures, IMAGE_TYPES)
        content = await _made(http, await checked(http), study_page.file, name, image_format)
        return Response(content, media_type=IMAGE_TYPES[image_format], headers=policy)

    async def report(http: Request) -> Response:
        found = await checked(http)
        parts = partial(report_pieces, http.app.state.studies.own, found, pages.printed_host(http))
        return await streamed(http, found.study, parts, pages.HTML, policy, PROGRESS_S)

    async def checked(http: Request) -> StudyPage:
        asked, _ = await pages.asked_of(http, calculation)
        found: StudyPage = await _planned(http, own, asked, study_page.checked)
        return found

    router.add_api_route(path, page, methods=pages.METHODS, response_class=HTMLResponse)
    router.add_api_route(f"{path}.{{media}}", lines, methods=pages.METHODS)
    router.add_api_route(f"{path}/report", report, methods=pages.METHODS, response_class=HTMLResponse)
    router.add_api_route(f"{path}/figures/{{name}}.{{image_format}}", figure, methods=pages.METHODS)


async def _planned(http: Request, own: type[StudyPage], asked: Asked, view: Callable[..., Any]) -> Any:
    """Return the result of `view` for the case `asked` and the study `own`; `view` runs in a worker."""
    if asked.pairs:
        await http.app.state.start_up.wait(http, asked.calculation.kernels.of())
    return await planned(http, partial(view, own, asked), getattr(http.app.state.settings, own.plan.most))


async def _made(http: Request, study: StudyPage, view: Callable[..., bytes | str], *arguments: Any) -> bytes:
    """Run a study to its end, let a worker make a page or file from the results, and return this page or file.

    Raises StudyEnded if the study ends with an error. Raises HTTPException with the reason if there is nothing to show.
    Raises ClientGone if the client leaves; the study then ends too.
    """

    async def work() -> bytes:
        lines, _ = await begun(http, study.study)
        async with aclosing(lines):
            received = [line async for group in lines for line in group if line["type"] != "progress"]
        if received[-1]["type"] == "error":
            raise StudyEnded(received[-1]["message"])
        shown: bytes | str = await twice_if_lost(http.app.state.studies.own(), view, study, received, *arguments)
        if isinstance(shown, str):
            raise HTTPException(404, shown)
        return shown

    with http.app.state.studies.place():
        content: bytes = await unless_gone(http, asyncio.create_task(work()))
        return content


for each in CALCULATIONS:
    for own_page in PAGES:
        if own_page.link in study_links(each):
            _add(each, own_page)
