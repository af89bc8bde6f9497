"""Pages and files of studies: made of the lines while they come, in the place that a study has."""

from collections.abc import AsyncGenerator, Callable
from contextlib import ExitStack
from typing import Any

from fastapi import Request, Response

from app.calculations import Calculation
from app.problems import DeadlineExceeded, WorkerLost
from app.routes.pages import HTML, PAGE_POLICY, TROUBLES, asked_of, html, sent_on, trouble_page
from app.routes.studies import PATIENCE_S, StudyStream
from app.settings import Settings
from app.studies.engine import twice_if_lost
from app.studies.office import Office
from app.studies.stream import Clock, Lines, guarded
from app.studies.study import Study
from app.workers.admission import Runner
from app.workers.start_up import StartUp

NOT_DRAWN = (
    b'<div class="frame"><p class="warning">The figure could not be drawn; the files hold the points.</p>'
    b'<span class="ready" hidden></span></div>'
)

Pieces = Callable[[Lines, Office], AsyncGenerator[bytes, None]]


async def study_page(
    http: Request,
    calculation: Calculation,
    place: str,
    view: Callable[..., Any],
    growing: Callable[[Any], tuple[Study, Pieces]],
) -> Response:
    """A study's page, whole where there is nothing to calculate."""
    try:
        asked, clean = await asked_of(http, calculation)
        if not clean and http.scope["method"] == "GET":
            return sent_on(place, asked)
        if asked.pairs:
            start_up(http).require(calculation.path)
        limits = limits_of(http)
        opened = await runner(http).run(http, view, asked, limits.most_study_points, limits.deadline_s)
        if opened.study is None:
            return html(opened.head + opened.tail, opened.status)
        return await stream(http, *growing(opened), HTML, PAGE_POLICY)
    except TROUBLES as error:
        return trouble_page(error)


async def stream(http: Request, study: Study, pieces: Pieces, media: str, policy: str) -> Response:
    """What is made of the lines of a study, while they come."""
    office: Office = http.app.state.office
    limits = limits_of(http)
    with ExitStack() as stack:
        stack.enter_context(office.place())
        clock = Clock(study.total)
        lines = guarded(study.lines(await office.pool(), clock), clock, limits.study_deadline_s)
        patience = limits.study_deadline_s + PATIENCE_S
        headers = {"Content-Security-Policy": policy}
        return StudyStream(pieces(lines, office), media, patience, stack.pop_all(), headers)


async def drawn(office: Office, view: Callable[..., bytes], *arguments: Any) -> bytes:
    """What a worker draws, or that it could not."""
    try:
        made: bytes = await twice_if_lost(office.own(), view, *arguments)
    except (WorkerLost, DeadlineExceeded):
        return NOT_DRAWN
    return made


def limits_of(http: Request) -> Settings:
    """What the service allows."""
    limits: Settings = http.app.state.settings
    return limits


def runner(http: Request) -> Runner:
    """Who calculates."""
    found: Runner = http.app.state.runner
    return found


def start_up(http: Request) -> StartUp:
    """What is ready yet."""
    found: StartUp = http.app.state.start_up
    return found
