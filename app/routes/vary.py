"""A case with fields varied: a page that grows while its points are calculated, and the same as files."""

import time
from collections.abc import AsyncGenerator
from contextlib import aclosing

from fastapi import APIRouter, HTTPException, Request, Response

from app.calculations import CALCULATIONS, Calculation
from app.figures.rendering import MEDIA_TYPES as IMAGE_TYPES
from app.pages.growing import Opened
from app.pages.templating import page_path
from app.pages.vary import views
from app.pages.vary.gathered import Gathered
from app.routes.pages import DOCUMENT_POLICY, METHODS, asked_of
from app.routes.studies import MEDIA_TYPES
from app.routes.study_streams import Pieces, drawn, limits_of, runner, start_up, stream, study_page
from app.studies.engine import twice_if_lost
from app.studies.office import Office
from app.studies.stream import Lines, StudyBroke, encoded, json_line
from app.studies.sweep import Sweep

FIRST_FRAME_S = 0.3
FRAME_SHARE = 0.3  # of the time a study has run passes until its next figure
LONGEST_PAUSE_S = 4.0
FIGURES = ("curve", "family", "map", "worst")

router = APIRouter(include_in_schema=False)


def _add(calculation: Calculation) -> None:
    path = f"{page_path(calculation)}/vary"

    async def page(http: Request) -> Response:
        return await study_page(http, calculation, path, views.opened, _grown)

    async def lines(http: Request, media: str) -> Response:
        """Every point, as the sweep's endpoint tells it."""
        kinds = {str(name): kind for name, kind in MEDIA_TYPES.items()}
        if media not in kinds:
            raise HTTPException(404, f"There are {', '.join(f'vary.{each}' for each in kinds)}")
        study = await _study(http, calculation)

        def pieces(found: Lines, _: Office) -> AsyncGenerator[bytes, None]:
            return encoded(found, study.sweep.table().encode if media == "csv" else json_line)

        return await stream(http, study.sweep, pieces, kinds[media], DOCUMENT_POLICY)

    async def figure(http: Request, name: str, image_format: str) -> Response:
        """One figure of the whole study as a file."""
        kinds = {str(each): kind for each, kind in IMAGE_TYPES.items()}
        if name not in FIGURES or image_format not in kinds:
            raise HTTPException(404, f"There are {', '.join(FIGURES)}, each as {', '.join(kinds)}")
        study = await _study(http, calculation)
        if name not in study.figures:
            raise HTTPException(404, f"This study has {', '.join(study.figures)}")
        pieces = _file_pieces(study, name, image_format)
        return await stream(http, study.sweep, pieces, kinds[image_format], DOCUMENT_POLICY)

    router.add_api_route(path, page, methods=METHODS)
    router.add_api_route(f"{path}.{{media}}", lines, methods=METHODS)
    router.add_api_route(f"{path}/figures/{{name}}.{{image_format}}", figure, methods=METHODS)


async def _study(http: Request, calculation: Calculation) -> views.Study:
    """The study of a query, for those who read files."""
    asked, _ = await asked_of(http, calculation)
    start_up(http).require(calculation.path)
    limits = limits_of(http)
    study: views.Study = await runner(http).run(http, views.planned, asked, limits.most_study_points, limits.deadline_s)
    return study


def _grown(opened: Opened[views.Study]) -> tuple[Sweep, Pieces]:
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
                    yield await drawn(office, views.frame, study, gathered)
                    due = elapsed + min(max(FRAME_SHARE * elapsed, FIRST_FRAME_S), LONGEST_PAUSE_S)
        yield await drawn(office, views.whole, study, gathered)
        yield opened.tail

    return study.sweep, pieces


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
        yield await twice_if_lost(office.own(), views.file, study, gathered, name, image_format)

    return pieces


for each in CALCULATIONS:
    _add(each)
