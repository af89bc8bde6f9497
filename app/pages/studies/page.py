"""The page of a sensitivity, of corners or of a design, and its files; runs in workers."""

import json
from dataclasses import replace

from app.calculations import Calculation
from app.errors import Unreadable
from app.figures.rendering import Format, written
from app.figures.tables import table
from app.pages.cases import Fault, faults_of
from app.pages.charts import embedded
from app.pages.links import IMAGE_FORMATS, examples_of
from app.pages.query import link, pairs_of
from app.pages.studies.corners import CORNERS
from app.pages.studies.declaration import FRAMES, Opened, PageStudy, Result, StudyAddresses, StudyPage, around
from app.pages.studies.design import DESIGN
from app.pages.studies.sensitivity import SENSITIVITY
from app.pages.studies.sweep_form import output_menu
from app.pages.studies.sweep_query import field_at_fault, shown_output
from app.pages.templating import page_path, rendered
from app.pages.views import REFUSED, Asked
from app.schema.fields import Leaf
from app.studies.stream import Line, StudyBroke

PAGES = {each.link: each for each in (SENSITIVITY, CORNERS, DESIGN)}


def opened(page: StudyPage, asked: Asked, most: int, deadline_s: float) -> Opened[PageStudy]:
    """The page of a study of a case, and the study if there is a case."""
    try:
        study = checked(page, asked, most, deadline_s) if asked.pairs else None
    except REFUSED as error:
        faults = [Fault(field_at_fault(each.path), each.message) for each in faults_of(error)]
        status = 400 if isinstance(error, Unreadable) else 422
        return Opened(_page(page, asked, None, faults).encode(), status=status)
    return around(_page(page, asked, study, []), study)


def checked(page: StudyPage, asked: Asked, most: int, deadline_s: float) -> PageStudy:
    """The study that is asked for; raises what refuses it, with paths into the study."""
    output = _output(page, asked.calculation, asked.views)
    body = json.dumps(page.body(asked, output)).encode()
    return PageStudy(page, asked, output, page.plan(body, most, deadline_s))


def _output(page: StudyPage, calculation: Calculation, said: dict[str, str]) -> Leaf:
    return shown_output(calculation, said if page.output is None else {"show": page.output, **said})


def _page(page: StudyPage, asked: Asked, study: PageStudy | None, faults: list[Fault]) -> str:
    calculation, offer = asked.calculation, page.link
    known = {fault.path: fault.message for fault in faults}
    menu, fields = output_menu(calculation, asked.views, known), page.fields(asked.views, known)
    return rendered(
        "study.html",
        asked.root,
        calculation=calculation,
        page=page,
        path=asked.path,
        case_links=asked.links,
        outdated=asked.outdated,
        links=StudyAddresses(offer.name, asked),
        show=replace(menu, empty=_output(page, calculation, {}).title),
        fields=fields,
        anchors={menu.name: menu.id} | {each.name: each.id for each in fields},
        hidden=[pair for pair in (*asked.pairs, ("theme", asked.views.get("theme", ""))) if pair[1]],
        faults=faults,
        theme=asked.views.get("theme", ""),
        study=study,
        starters=[
            (example, link(f"{page_path(calculation)}/{offer.name}", pairs_of(example.request)))
            for example in examples_of(calculation)
        ],
        frames=FRAMES,
    )


def whole(study: PageStudy, lines: list[Line]) -> bytes:
    """Figures, tables and links; a study that broke off says why."""
    links = StudyAddresses(study.page.link.name, study.asked)
    if lines[-1]["type"] == "error":
        return rendered("study_result.html", study.asked.root, broke=lines[-1]["message"]).encode()
    found = study.page.result(study, lines)
    charts = [embedded(name, figure, study.asked.theme) for name, figure in found.figures.items()]
    return rendered(
        "study_result.html",
        study.asked.root,
        broke=None,
        found=found,
        charts=charts,
        links=links,
        formats=IMAGE_FORMATS,
    ).encode()


def file(study: PageStudy, lines: list[Line], name: str, image_format: Format) -> bytes:
    """One figure as a file; raises StudyBroke where the study has none in the end."""
    if lines[-1]["type"] == "error":
        raise StudyBroke(lines[-1]["message"])
    found: Result = study.page.result(study, lines)
    if name not in found.figures:
        raise StudyBroke("; ".join(found.remarks))
    figure = found.figures[name]
    return table(figure) if image_format == "csv" else written(figure, image_format, study.asked.theme or "light")
