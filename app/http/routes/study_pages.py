"""Pages of the studies of a case and their files, written while the lines of a study come."""

import time
from collections.abc import AsyncGenerator, Callable
from contextlib import ExitStack, aclosing
from functools import partial
from typing import Any

from fastapi import APIRouter, HTTPException, Request, Response

from app.calculations import CALCULATIONS, Calculation
from app.errors import DeadlineExceeded, WorkerLost
from app.figures.rendering import MEDIA_TYPES as IMAGE_TYPES
from app.http.routes.pages import (
    DOCUMENT_POLICY,
    HTML,
    METHODS,
    PAGE_POLICY,
    TROUBLES,
    asked_of,
    html,
    redirected,
    trouble_page,
)
from app.http.routes.studies import MEDIA_TYPES, PATIENCE_S, StudyStream
from app.pages.studies import page as pages
from app.pages.studies import sweep as sweeps
from app.pages.studies.declaration import Opened, PageStudy, StudyPage
from app.pages.study_links import study_links
from app.pages.templating import page_path, rendered
from app.settings import Settings
from app.studies.admission import StudyAdmission
from app.studies.engine import twice_if_lost
from app.studies.stream import Clock, Line, Lines, StudyBroke, encoded, guarded, json_line
from app.studies.study import Study
from app.workers.admission import Runner
from app.workers.start_up import StartUp

PROGRESS_S = 1.0  # between two messages that say how far a study has come
FIRST_FRAME_S = 0.3
FRAME_SHARE = 0.3  # of the time a sweep has run passes until its next figure
LONGEST_PAUSE_S = 4.0
SWEEP_FIGURES = ("curve", "family", "map", "worst")
NOT_DRAWN = (
    b'<div class="frame"><p class="warning">The figure could not be drawn; the files hold the points.</p>'
    b'<span class="ready" hidden></span></div>'
)

Pieces = Callable[[Lines, StudyAdmission], AsyncGenerator[bytes, None]]
"""What is written of the lines of a study while they come."""

router = APIRouter(include_in_schema=False)


def _add_study(calculation: Calculation, own: StudyPage) -> None:
    """The pages of a sensitivity, of corners or of a design."""
    path = f"{page_path(calculation)}/{own.link.name}"
    checked = partial(pages.checked, own)

    async def page(http: Request) -> Response:
        return await _page(http, calculation, path, partial(pages.opened, own), _progress_page)

    async def lines(http: Request) -> Response:
        study = await _checked(http, calculation, checked)
        return await _stream(http, study.study, _encoded(json_line), MEDIA_TYPES["ndjson"], DOCUMENT_POLICY)

    async def figure(http: Request, name: str, image_format: str) -> Response:
        media = _media_of(name, image_format, own.figures)
        study = await _checked(http, calculation, checked)

        async def pieces(lines: Lines, admission: StudyAdmission) -> AsyncGenerator[bytes, None]:
            found = [line async for line in _without_progress(lines)]
            yield await twice_if_lost(admission.own(), pages.file, study, found, name, image_format)

        return await _stream(http, study.study, pieces, media, DOCUMENT_POLICY)

    router.add_api_route(path, page, methods=METHODS)
    router.add_api_route(f"{path}.ndjson", lines, methods=METHODS)
    router.add_api_route(f"{path}/figures/{{name}}.{{image_format}}", figure, methods=METHODS)


def _add_sweep(calculation: Calculation) -> None:
    """The pages of a sweep, whose figures are drawn while its points come."""
    path = f"{page_path(calculation)}/{sweeps.NAME}"

    async def page(http: Request) -> Response:
        return await _page(http, calculation, path, sweeps.opened, _figure_page)

    async def lines(http: Request, media: str) -> Response:
        kinds = {str(name): kind for name, kind in MEDIA_TYPES.items()}
        if media not in kinds:
            raise HTTPException(404, f"There are {', '.join(f'{sweeps.NAME}.{each}' for each in kinds)}")
        study = await _checked(http, calculation, sweeps.checked)
        encode = study.sweep.table().encode if media == "csv" else json_line
        return await _stream(http, study.sweep, _encoded(encode), kinds[media], DOCUMENT_POLICY)

    async def figure(http: Request, name: str, image_format: str) -> Response:
        media = _media_of(name, image_format, SWEEP_FIGURES)
        study = await _checked(http, calculation, sweeps.checked)
        if name not in study.figures:
            raise HTTPException(404, f"This study has {', '.join(study.figures)}")

        async def pieces(lines: Lines, admission: StudyAdmission) -> AsyncGenerator[bytes, None]:
            received = sweeps.ReceivedPoints(study.sweep.total)
            async for line in _without_progress(lines):
                received.add(line)
            if received.broke:
                raise StudyBroke(received.broke)
            yield await twice_if_lost(admission.own(), sweeps.file, study, received, name, image_format)

        return await _stream(http, study.sweep, pieces, media, DOCUMENT_POLICY)

    router.add_api_route(path, page, methods=METHODS)
    router.add_api_route(f"{path}.{{media}}", lines, methods=METHODS)
    router.add_api_route(f"{path}/figures/{{name}}.{{image_format}}", figure, methods=METHODS)


async def _page(
    http: Request,
    calculation: Calculation,
    path: str,
    view: Callable[..., Any],
    pieces_of: Callable[[Any], tuple[Study, Pieces]],
) -> Response:
    """A study's page; whole where there is nothing to calculate."""
    try:
        asked, clean = await asked_of(http, calculation)
        if not clean and http.scope["method"] == "GET":
            return redirected(path, asked)
        if asked.pairs:
            _start_up(http).require(calculation.path)
        limits = _limits(http)
        opened = await _runner(http).run(http, view, asked, limits.most_study_points, limits.deadline_s)
        if opened.study is None:
            return html(opened.head + opened.tail, opened.status)
        return await _stream(http, *pieces_of(opened), HTML, PAGE_POLICY)
    except TROUBLES as error:
        return trouble_page(http, error)


async def _checked(http: Request, calculation: Calculation, check: Callable[..., Any]) -> Any:
    """The study of a query, for a file; checked in a worker."""
    asked, _ = await asked_of(http, calculation)
    _start_up(http).require(calculation.path)
    limits = _limits(http)
    return await _runner(http).run(http, check, asked, limits.most_study_points, limits.deadline_s)


async def _stream(http: Request, study: Study, pieces: Pieces, media: str, policy: str) -> Response:
    """The pieces of a study, which takes its place among those that run."""
    admission: StudyAdmission = http.app.state.studies
    limits = _limits(http)
    with ExitStack() as stack:
        stack.enter_context(admission.place())
        clock = Clock(study.total)
        lines = guarded(study.lines(await admission.pool(), clock), clock, limits.study_deadline_s)
        patience = limits.study_deadline_s + PATIENCE_S
        headers = {"Content-Security-Policy": policy}
        return StudyStream(pieces(lines, admission), media, patience, stack.pop_all(), headers)


def _progress_page(opened: Opened[PageStudy]) -> tuple[Study, Pieces]:
    """A study, and its page: head, how far it has come, its result, tail."""
    study = opened.study
    assert study is not None

    async def pieces(lines: Lines, admission: StudyAdmission) -> AsyncGenerator[bytes, None]:
        yield opened.head
        found: list[Line] = []
        done, due = 0, time.perf_counter() + PROGRESS_S
        async with aclosing(lines):
            async for group in lines:
                found += [line for line in group if line["type"] != "progress"]
                done = _done(group, done)
                if done and time.perf_counter() >= due:
                    yield rendered("progress.html", "", done=done, total=study.study.total).encode()
                    due = time.perf_counter() + PROGRESS_S
        yield await _drawn(admission, pages.whole, study, found)
        yield opened.tail

    return study.study, pieces


def _done(group: list[Line], before: int) -> int:
    """How many points are solved, as far as the lines say."""
    points = len([line for line in group if line["type"] == "point"])
    stated = [int(line["done"]) for line in group if line["type"] == "progress"]
    return max([before + points, *stated])


def _figure_page(opened: Opened[sweeps.SweepStudy]) -> tuple[Study, Pieces]:
    """A sweep, and its page: head, figures that replace each other, tail."""
    study = opened.study
    assert study is not None

    async def pieces(lines: Lines, admission: StudyAdmission) -> AsyncGenerator[bytes, None]:
        yield opened.head
        received, started, due = sweeps.ReceivedPoints(study.sweep.total), time.perf_counter(), FIRST_FRAME_S
        async with aclosing(lines):
            async for group in lines:
                for line in group:
                    received.add(line)
                elapsed = time.perf_counter() - started
                if elapsed >= due and 0 < received.done < received.total:
                    yield await _drawn(admission, sweeps.frame, study, received)
                    due = elapsed + min(max(FRAME_SHARE * elapsed, FIRST_FRAME_S), LONGEST_PAUSE_S)
        yield await _drawn(admission, sweeps.whole, study, received)
        yield opened.tail

    return study.sweep, pieces


def _encoded(encode: Callable[[Line], bytes]) -> Pieces:
    """The lines of a study as they are."""
    return lambda lines, _: encoded(lines, encode)


async def _without_progress(lines: Lines) -> AsyncGenerator[Line, None]:
    async with aclosing(lines):
        async for group in lines:
            for line in group:
                if line["type"] != "progress":
                    yield line


async def _drawn(admission: StudyAdmission, view: Callable[..., bytes], *arguments: Any) -> bytes:
    """What a worker draws, or that it could not."""
    try:
        made: bytes = await twice_if_lost(admission.own(), view, *arguments)
    except (WorkerLost, DeadlineExceeded):
        return NOT_DRAWN
    return made


def _media_of(name: str, image_format: str, figures: tuple[str, ...]) -> str:
    """The media type of a figure's file; 404 where there is none."""
    kinds = {str(each): kind for each, kind in IMAGE_TYPES.items()}
    if name not in figures or image_format not in kinds:
        raise HTTPException(404, f"There are {', '.join(figures)}, each as {', '.join(kinds)}")
    return kinds[image_format]


def _limits(http: Request) -> Settings:
    limits: Settings = http.app.state.settings
    return limits


def _runner(http: Request) -> Runner:
    found: Runner = http.app.state.runner
    return found


def _start_up(http: Request) -> StartUp:
    found: StartUp = http.app.state.start_up
    return found


for each in CALCULATIONS:
    _add_sweep(each)
    for study_link in study_links(each):
        _add_study(each, pages.PAGES[study_link])
