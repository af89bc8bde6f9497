"""A case with fields varied: a page that grows while its points are calculated, and the same as files."""

import time
from collections.abc import AsyncGenerator, Callable
from contextlib import ExitStack, aclosing
from typing import Any

from fastapi import APIRouter, HTTPException, Request, Response

from app.calculations import CALCULATIONS, Calculation
from app.figures.rendering import MEDIA_TYPES as IMAGE_TYPES
from app.pages.templating import page_path
from app.pages.vary import influence, views
from app.pages.vary.gathered import Gathered
from app.problems import DeadlineExceeded, WorkerLost
from app.routes.pages import (
    DOCUMENT_POLICY,
    HTML,
    METHODS,
    PAGE_POLICY,
    TROUBLES,
    asked_of,
    html,
    sent_on,
    trouble_page,
)
from app.routes.studies import MEDIA_TYPES, PATIENCE_S, StudyStream
from app.settings import Settings
from app.start_up import StartUp
from app.studies.engine import twice_if_lost
from app.studies.lines import StudyBroke, encoded, json_line
from app.studies.office import Office
from app.studies.sensitivity import Sensitivity
from app.studies.stream import Clock, Lines, guarded
from app.studies.sweep import Sweep
from app.workers.admission import Runner

FIRST_FRAME_S = 0.3
FRAME_SHARE = 0.3  # of the time a study has run passes until its next figure
LONGEST_PAUSE_S = 4.0
FIGURES = ("curve", "family", "map", "worst")
NOT_DRAWN = (
    b'<div class="frame"><p class="warning">The figure could not be drawn; the files hold the points.</p>'
    b'<span class="ready" hidden></span></div>'
)

router = APIRouter(include_in_schema=False)
Pieces = Callable[[Lines, Office], AsyncGenerator[bytes, None]]
Asking = Sweep | Sensitivity


def _add(calculation: Calculation) -> None:
    path, influence_path = (f"{page_path(calculation)}/{below}" for below in ("vary", "influence"))

    async def page(http: Request) -> Response:
        return await _page(http, calculation, path, views.opened, _grown)

    async def matters(http: Request) -> Response:
        return await _page(http, calculation, influence_path, influence.opened, _ranked)

    async def lines(http: Request, media: str) -> Response:
        """Every point, as the sweep's endpoint tells it."""
        kinds = {str(name): kind for name, kind in MEDIA_TYPES.items()}
        if media not in kinds:
            raise HTTPException(404, f"There are {', '.join(f'vary.{each}' for each in kinds)}")
        study = await _study(http, calculation)

        def pieces(found: Lines, _: Office) -> AsyncGenerator[bytes, None]:
            return encoded(found, study.sweep.table().encode if media == "csv" else json_line)

        return await _stream(http, study.sweep, pieces, kinds[media], DOCUMENT_POLICY)

    async def figure(http: Request, name: str, image_format: str) -> Response:
        """One figure of the whole study as a file."""
        kinds = {str(each): kind for each, kind in IMAGE_TYPES.items()}
        if name not in FIGURES or image_format not in kinds:
            raise HTTPException(404, f"There are {', '.join(FIGURES)}, each as {', '.join(kinds)}")
        study = await _study(http, calculation)
        if name not in study.figures:
            raise HTTPException(404, f"This study has {', '.join(study.figures)}")
        pieces = _file_pieces(study, name, image_format)
        return await _stream(http, study.sweep, pieces, kinds[image_format], DOCUMENT_POLICY)

    router.add_api_route(path, page, methods=METHODS)
    router.add_api_route(influence_path, matters, methods=METHODS)
    router.add_api_route(f"{path}.{{media}}", lines, methods=METHODS)
    router.add_api_route(f"{path}/figures/{{name}}.{{image_format}}", figure, methods=METHODS)


async def _page(
    http: Request,
    calculation: Calculation,
    place: str,
    view: Callable[..., Any],
    growing: Callable[[Any], tuple[Asking, Pieces]],
) -> Response:
    """A study's page, whole where there is nothing to calculate."""
    try:
        asked, clean = await asked_of(http, calculation)
        if not clean and http.scope["method"] == "GET":
            return sent_on(place, asked)
        if asked.pairs:
            _start_up(http).require(calculation.path)
        limits = _limits(http)
        opened = await _runner(http).run(http.receive, view, asked, limits.most_study_points, limits.deadline_s)
        if opened.study is None:
            return html(opened.head + opened.tail, opened.status)
        return await _stream(http, *growing(opened), HTML, PAGE_POLICY)
    except TROUBLES as error:
        return trouble_page(error)


async def _study(http: Request, calculation: Calculation) -> views.Study:
    """The study of a query, for those who read files."""
    asked, _ = await asked_of(http, calculation)
    _start_up(http).require(calculation.path)
    limits = _limits(http)
    study: views.Study = await _runner(http).run(
        http.receive, views.planned, asked, limits.most_study_points, limits.deadline_s
    )
    return study


async def _stream(http: Request, study: Asking, pieces: Pieces, media: str, policy: str) -> Response:
    """What is made of the lines of a study, while they come."""
    office: Office = http.app.state.office
    limits = _limits(http)
    with ExitStack() as stack:
        stack.enter_context(office.place())
        clock = Clock(study.total)
        lines = guarded(study.lines(await office.pool(), clock), clock, limits.study_deadline_s)
        patience = limits.study_deadline_s + PATIENCE_S
        headers = {"Content-Security-Policy": policy}
        return StudyStream(pieces(lines, office), media, patience, stack.pop_all(), headers)


def _grown(opened: views.Opened) -> tuple[Asking, Pieces]:
    """A sweep, and its page: head, figures that replace each other, tail."""
    assert opened.study is not None
    study = opened.study

    async def pieces(lines: Lines, office: Office) -> AsyncGenerator[bytes, None]:
        yield opened.head
        gathered, started, due = Gathered(study.sweep.total), time.perf_counter(), FIRST_FRAME_S
        async with aclosing(lines):
            async for group in lines:
                for line in group:
                    gathered.add(line)
                elapsed = time.perf_counter() - started
                if elapsed >= due and 0 < gathered.done < gathered.total:
                    yield await _drawn(office, views.frame, study, gathered)
                    due = elapsed + min(max(FRAME_SHARE * elapsed, FIRST_FRAME_S), LONGEST_PAUSE_S)
        yield await _drawn(office, views.whole, study, gathered)
        yield opened.tail

    return study.sweep, pieces


def _ranked(opened: influence.Opened) -> tuple[Asking, Pieces]:
    """A study of sensitivity, and its page: head, figure, tail."""
    assert opened.study is not None
    study = opened.study

    async def pieces(lines: Lines, office: Office) -> AsyncGenerator[bytes, None]:
        yield opened.head
        async with aclosing(lines):
            found = [line async for group in lines for line in group if line["type"] != "progress"]
        yield await _drawn(office, influence.whole, study, found)
        yield opened.tail

    return study.sensitivity, pieces


async def _drawn(office: Office, view: Callable[..., bytes], *arguments: Any) -> bytes:
    try:
        drawn: bytes = await twice_if_lost(office.own, view, *arguments)
    except (WorkerLost, DeadlineExceeded):
        return NOT_DRAWN
    return drawn


def _file_pieces(study: views.Study, name: str, image_format: str) -> Pieces:
    async def pieces(lines: Lines, office: Office) -> AsyncGenerator[bytes, None]:
        """The file in one piece; a study that breaks off has none."""
        gathered = Gathered(study.sweep.total)
        async with aclosing(lines):
            async for group in lines:
                for line in group:
                    gathered.add(line)
        if gathered.broke:
            raise StudyBroke(gathered.broke)
        yield await twice_if_lost(office.own, views.file, study, gathered, name, image_format)

    return pieces


def _limits(http: Request) -> Settings:
    limits: Settings = http.app.state.settings
    return limits


def _runner(http: Request) -> Runner:
    runner: Runner = http.app.state.runner
    return runner


def _start_up(http: Request) -> StartUp:
    start_up: StartUp = http.app.state.start_up
    return start_up


for each in CALCULATIONS:
    _add(each)
