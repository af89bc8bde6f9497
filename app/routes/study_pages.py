"""Studies of a case that have a page of their own, and the same as files."""

import time
from collections.abc import AsyncGenerator
from contextlib import aclosing
from functools import partial

from fastapi import APIRouter, HTTPException, Request, Response

from app.calculations import CALCULATIONS, Calculation
from app.figures.rendering import MEDIA_TYPES as IMAGE_TYPES
from app.pages.growing import Opened
from app.pages.offers import offers_of
from app.pages.studies import page as pages
from app.pages.studies.declaration import Asking, StudyPage
from app.pages.templating import page_path, rendered
from app.routes.pages import DOCUMENT_POLICY, METHODS, asked_of
from app.routes.studies import MEDIA_TYPES
from app.routes.study_streams import Pieces, drawn, limits_of, runner, start_up, stream, study_page
from app.studies.engine import twice_if_lost
from app.studies.office import Office
from app.studies.stream import Line, Lines, encoded, json_line
from app.studies.study import Study

FRAME_S = 1.0  # between two frames that say how far the study has come

router = APIRouter(include_in_schema=False)


def _add(calculation: Calculation, own: StudyPage) -> None:
    path = f"{page_path(calculation)}/{own.offer.name}"

    async def page(http: Request) -> Response:
        return await study_page(http, calculation, path, partial(pages.opened, own), _told)

    async def lines(http: Request) -> Response:
        """Every line, as the study's endpoint tells it."""
        asking = await _asking(http, calculation, own)

        def pieces(found: Lines, _: Office) -> AsyncGenerator[bytes, None]:
            return encoded(found, json_line)

        return await stream(http, asking.study, pieces, MEDIA_TYPES["ndjson"], DOCUMENT_POLICY)

    async def figure(http: Request, name: str, image_format: str) -> Response:
        """One figure of the whole study as a file."""
        kinds = {str(each): kind for each, kind in IMAGE_TYPES.items()}
        if name not in own.figures or image_format not in kinds:
            raise HTTPException(404, f"There are {', '.join(own.figures)}, each as {', '.join(kinds)}")
        asking = await _asking(http, calculation, own)

        async def pieces(found: Lines, office: Office) -> AsyncGenerator[bytes, None]:
            yield await twice_if_lost(office.own(), pages.file, asking, await _gathered(found), name, image_format)

        return await stream(http, asking.study, pieces, kinds[image_format], DOCUMENT_POLICY)

    router.add_api_route(path, page, methods=METHODS)
    router.add_api_route(f"{path}.ndjson", lines, methods=METHODS)
    router.add_api_route(f"{path}/figures/{{name}}.{{image_format}}", figure, methods=METHODS)


async def _asking(http: Request, calculation: Calculation, own: StudyPage) -> Asking:
    """The study of a query, for those who read files."""
    asked, _ = await asked_of(http, calculation)
    start_up(http).require(calculation.path)
    limits = limits_of(http)
    asking: Asking = await runner(http).run(
        http, pages.planned, own, asked, limits.most_study_points, limits.deadline_s
    )
    return asking


async def _gathered(lines: Lines) -> list[Line]:
    async with aclosing(lines):
        return [line async for group in lines for line in group if line["type"] != "progress"]


def _told(opened: Opened[Asking]) -> tuple[Study, Pieces]:
    """A study, and its page: head, how far it has come, its result, tail."""
    assert opened.study is not None
    asking = opened.study

    async def pieces(lines: Lines, office: Office) -> AsyncGenerator[bytes, None]:
        yield opened.head
        found: list[Line] = []
        done, due = 0, time.perf_counter() + FRAME_S
        async with aclosing(lines):
            async for group in lines:
                found += [line for line in group if line["type"] != "progress"]
                done = _done(group, done)
                if done and time.perf_counter() >= due:
                    yield rendered("progress.html", done=done, total=asking.study.total).encode()
                    due = time.perf_counter() + FRAME_S
        yield await drawn(office, pages.whole, asking, found)
        yield opened.tail

    return asking.study, pieces


def _done(group: list[Line], before: int) -> int:
    """How many cases are done, as far as the lines tell."""
    points = len([line for line in group if line["type"] == "point"])
    told = [int(line["done"]) for line in group if line["type"] == "progress"]
    return max([before + points, *told])


for each_calculation in CALCULATIONS:
    for each_offer in offers_of(each_calculation):
        _add(each_calculation, pages.PAGES[each_offer])
