"""The page of a study: what stands before and after its figures, the figures as they grow, files; runs in workers."""

import json
from dataclasses import dataclass, replace
from typing import Any

from app.figures.data import Figure
from app.figures.rendering import Format, written
from app.figures.studies import figures_of
from app.figures.tables import table
from app.pages.cases import Fault, faults_of
from app.pages.charts import embedded
from app.pages.growing import FRAMES, Opened, StudyLinks, around
from app.pages.links import IMAGE_FORMATS
from app.pages.points import address_at
from app.pages.query import STUDY_NAMES
from app.pages.templating import rendered
from app.pages.typesetting import shown
from app.pages.vary.controls import controls
from app.pages.vary.examples import studies_of
from app.pages.vary.gathered import Gathered, grid_of
from app.pages.vary.wish import Wish, case_of, field_at_fault, is_leaf, sweep_of, wish_of
from app.pages.views import REFUSED, Asked
from app.reading import Unreadable
from app.schema.fields import Leaf
from app.studies.fields import value_at
from app.studies.sweep import Sweep, sweep_study

NAME = "vary"
MOST_ROWS = 200


@dataclass(frozen=True, slots=True)
class Study:
    """A sweep asked for on a page."""

    asked: Asked
    wish: Wish
    sweep: Sweep
    limit: float | None

    @property
    def figures(self) -> tuple[str, ...]:
        """Names of its figures, which depend on how many fields and values it has."""
        return tuple(_figures(self, Gathered(self.sweep.total)))

    @property
    def links(self) -> StudyLinks:
        """Where the views of the study are."""
        return StudyLinks(NAME, self.asked)

    def opened(self, index: int) -> str:
        """The page of the case at a point."""
        return address_at(self.asked, self.sweep.points.overrides(index))


def opened(asked: Asked, most: int, deadline_s: float) -> Opened[Study]:
    """The page of a study, and the study if what is asked for makes one."""
    try:
        study = planned(asked, most, deadline_s) if asked.pairs and asked.views.get("x") else None
    except REFUSED as error:
        faults = [Fault(field_at_fault(each.path), each.message) for each in faults_of(error)]
        return Opened(_page(asked, None, faults).encode(), status=400 if isinstance(error, Unreadable) else 422)
    return around(_page(asked, study, []), study)


def planned(asked: Asked, most: int, deadline_s: float) -> Study:
    """The study that is asked for; raises what refuses it, with paths into the sweep."""
    calculation = asked.calculation
    case = case_of(calculation, asked.pairs)
    wish = wish_of(calculation, case, asked.views)
    sweep = sweep_study(sweep_of(calculation, asked.pairs, wish), most, deadline_s)
    return Study(asked, wish, sweep, _limit(wish.output, case))


def _limit(output: Leaf, case: dict[str, Any]) -> float | None:
    """What bounds the output, where that is a number of its own or of the case."""
    limit = output.limit if output.bound else None
    if isinstance(limit, str):
        try:
            limit = value_at(case, limit)
        except AttributeError:
            return None
    return float(limit) if isinstance(limit, int | float) else None


def _page(asked: Asked, study: Study | None, faults: list[Fault]) -> str:
    calculation = asked.calculation
    case = {} if any(not fault.path for fault in faults) else case_of(calculation, asked.pairs)
    known = {fault.path: fault.message for fault in faults}
    return rendered(
        "vary.html",
        calculation=calculation,
        path=asked.path,
        case_links=asked.links,
        outdated=asked.outdated,
        links=StudyLinks(NAME, asked),
        controls=controls(calculation, case, asked.views, known, study.wish if study else None),
        hidden=[pair for pair in (*asked.pairs, ("theme", asked.views.get("theme", ""))) if pair[1]],
        faults=[fault for fault in faults if fault.path not in STUDY_NAMES],
        refused=bool(faults),
        theme=asked.views.get("theme", ""),
        study=study,
        studies=studies_of(calculation),
        frames=FRAMES,
    )


def frame(study: Study, gathered: Gathered) -> bytes:
    """The first figure with the points that have come."""
    figure = next(iter(_figures(study, gathered).values()))
    return rendered("frame.html", chart=embedded("", figure, study.asked.theme), gathered=gathered).encode()


def whole(study: Study, gathered: Gathered) -> bytes:
    """Every figure, every point with a link to its case, and what was said of them."""
    figures = _figures(study, gathered)
    charts = [embedded(name, figure, study.asked.theme) for name, figure in figures.items()]
    charts[0] = replace(charts[0], study=_points(study, gathered, next(iter(figures.values()))))
    return rendered(
        "whole.html",
        charts=charts,
        links=study.links,
        formats=IMAGE_FORMATS,
        gathered=gathered,
        study=study,
        rows=[_row(study, gathered, index) for index in range(min(gathered.done, MOST_ROWS))],
        more=max(gathered.done - MOST_ROWS, 0),
    ).encode()


def file(study: Study, gathered: Gathered, name: str, image_format: Format) -> bytes:
    """One figure as a file; the study has it."""
    figure = _figures(study, gathered)[name]
    return table(figure) if image_format == "csv" else written(figure, image_format, study.asked.theme or "light")


def _figures(study: Study, gathered: Gathered) -> dict[str, Figure]:
    return figures_of(grid_of(study.wish, study.sweep, gathered, study.limit))


def _row(study: Study, gathered: Gathered, index: int) -> dict[str, Any]:
    at = study.sweep.points.overrides(index).values()
    return {
        "at": [shown(each, 6) for each in at],
        "value": shown(gathered.out[index]),
        "status": gathered.status[index].replace("_", " "),
        "said": ", ".join(gathered.said[index]),
        "address": study.opened(index),
    }


def _points(study: Study, gathered: Gathered, figure: Figure) -> str:
    """What the script needs to tell the point under the pointer and to open its case."""
    if not all(is_leaf(study.asked.calculation, each.path) for each in study.wish.fields):
        return ""
    from app.figures.drawing.image import places  # noqa: PLC0415  only workers draw

    place = places(figure)[0]
    axes = [
        {"path": each.path, "name": each.leaf.title, "unit": each.leaf.unit or "", "at": axis.values}
        for each, axis in zip(study.wish.fields, study.sweep.points.axes, strict=True)
    ]
    said = {
        "address": study.opened(0),
        "axes": axes,
        "out": gathered.out,
        "title": study.wish.output.title,
        "unit": study.wish.output.unit or "",
        "map": place.panel.map is not None,
        "box": place.box,
        "ranges": [place.x, place.y],
    }
    return json.dumps(said)
