"""The page of a sweep: a case with one field or two varied, drawn while its points are solved; runs in workers."""

import json
from collections import Counter
from dataclasses import dataclass, field, replace
from math import nan
from typing import Any

import numpy as np

from app.errors import Unreadable
from app.figures.data import Axis, Figure, values
from app.figures.rendering import Format, written
from app.figures.studies import Coordinate, Grid, figures_of
from app.figures.tables import table
from app.pages.cases import Fault, faults_of
from app.pages.charts import embedded
from app.pages.links import IMAGE_FORMATS
from app.pages.query import STUDY_NAMES
from app.pages.studies.declaration import FRAMES, Opened, StudyAddresses, address_at, around
from app.pages.studies.sweep_examples import studies_of
from app.pages.studies.sweep_form import controls
from app.pages.studies.sweep_query import SweepQuery, Varied, case_of, field_at_fault, is_leaf, query_of, sweep_of
from app.pages.templating import rendered
from app.pages.typesetting import shown, words
from app.pages.views import REFUSED, Asked
from app.schema.fields import Leaf
from app.studies.fields import value_at
from app.studies.requests import Scalar
from app.studies.stream import Line
from app.studies.sweep import Sweep, sweep_study

SOLVED = ("ok", "ok_with_warnings")


@dataclass(slots=True)
class ReceivedPoints:
    """What came of each point: value, outcome, what was said of it; `broke` says why there will be no more."""

    total: int
    out: list[float | None] = field(default_factory=list)
    status: list[str] = field(default_factory=list)
    said: list[tuple[str, ...]] = field(default_factory=list)
    elapsed_s: float | None = None
    broke: str | None = None

    def add(self, line: Line) -> None:
        """Take in the next line."""
        match line["type"]:
            case "point":
                error = line.get("error")
                self.out.append(line["out"][0])
                self.status.append(line["status"])
                self.said.append((error["message"],) if error else tuple(map(words, line["warnings"])))
            case "end":
                self.elapsed_s = line["elapsed_s"]
            case "error":
                self.broke = line["message"]

    @property
    def done(self) -> int:
        """How many points have come."""
        return len(self.out)

    @property
    def unsolved(self) -> int:
        """How many of them have no solution."""
        return sum(each not in SOLVED for each in self.status)

    @property
    def reasons(self) -> list[tuple[str, int]]:
        """What was said, how often, the most frequent first."""
        return Counter(text for said in self.said for text in said).most_common()


def grid_of(query: SweepQuery, sweep: Sweep, received: ReceivedPoints, limit: float | None) -> Grid:
    """The data of the figures; a point that has not come yet is a gap."""
    axes = [each.values or [] for each in sweep.points.axes]
    sizes = [len(each) for each in axes]
    found = np.full(sweep.points.total, nan)
    found[: received.done] = [nan if each is None else float(each) for each in received.out]
    known = found.reshape(sizes)
    coordinates, orders = [], []
    for varied, listed in zip(query.fields, axes, strict=True):
        coordinate, order = _coordinate(varied, listed)
        coordinates.append(coordinate)
        orders.append(order)
    warned: tuple[str | None, ...] = ()
    if len(sizes) == 1 and received.done == received.total:
        outside = [
            ", ".join(said) if status == "ok_with_warnings" else None
            for said, status in zip(received.said, received.status, strict=True)
        ]
        warned = tuple(outside[place] for place in orders[0])
    return Grid(
        x=coordinates[0],
        y=coordinates[1] if len(coordinates) > 1 else None,
        output=Axis(query.output.title, query.output.unit),
        values=values(known[np.ix_(*orders)]),
        greatest=query.greatest,
        limit=limit,
        warned=warned if len(set(warned)) > 1 else (),
        unsolved=received.unsolved,
    )


def _coordinate(varied: Varied, listed: list[Scalar | list[Scalar]]) -> tuple[Coordinate, list[int]]:
    """The values of a field in rising order, and the places where they stand in the sweep."""
    leaf: Leaf = varied.leaf
    if not all(isinstance(each, int | float) and not isinstance(each, bool) for each in listed):
        texts = tuple(_word(each) for each in listed)
        return Coordinate(Axis(leaf.title), values(list(range(len(listed)))), texts), list(range(len(listed)))
    numbers = np.array(listed, dtype=np.float64)
    order = np.argsort(numbers, kind="stable")
    rising = values(numbers[order])
    log = varied.axis.get("scale") == "log"
    limits = (float(rising[0]), float(rising[-1])) if log else None
    axis = Axis(leaf.title, leaf.unit, log=log, magnitude=False, limits=limits)
    scatters = leaf.declared.tolerance is not None
    return Coordinate(axis, rising, own=varied.own, scatters=scatters), order.tolist()


def _word(value: Any) -> str:
    return ("yes" if value else "no") if isinstance(value, bool) else words(str(value))


NAME = "vary"
MOST_ROWS = 200


@dataclass(frozen=True, slots=True)
class SweepStudy:
    """A sweep asked for on a page."""

    asked: Asked
    query: SweepQuery
    sweep: Sweep
    limit: float | None

    @property
    def figures(self) -> tuple[str, ...]:
        """Names of its figures, which depend on how many fields and values it has."""
        return tuple(_figures(self, ReceivedPoints(self.sweep.total)))

    @property
    def links(self) -> StudyAddresses:
        """Where the views of the study are."""
        return StudyAddresses(NAME, self.asked)

    def opened(self, index: int) -> str:
        """The page of the case at a point."""
        return address_at(self.asked, self.sweep.points.overrides(index))


def opened(asked: Asked, most: int, deadline_s: float) -> Opened[SweepStudy]:
    """The page of a study, and the study if what is asked for makes one."""
    try:
        study = checked(asked, most, deadline_s) if asked.pairs and asked.views.get("x") else None
    except REFUSED as error:
        faults = [Fault(field_at_fault(each.path), each.message) for each in faults_of(error)]
        return Opened(_page(asked, None, faults).encode(), status=400 if isinstance(error, Unreadable) else 422)
    return around(_page(asked, study, []), study)


def checked(asked: Asked, most: int, deadline_s: float) -> SweepStudy:
    """The study that is asked for; raises what refuses it, with paths into the sweep."""
    calculation = asked.calculation
    case = case_of(calculation, asked.pairs)
    query = query_of(calculation, case, asked.views)
    sweep = sweep_study(sweep_of(calculation, asked.pairs, query), most, deadline_s)
    return SweepStudy(asked, query, sweep, _limit(query.output, case))


def _limit(output: Leaf, case: dict[str, Any]) -> float | None:
    """What bounds the output, where that is a number of its own or of the case."""
    limit = output.view.limit if output.view.bound else None
    if isinstance(limit, str):
        try:
            limit = value_at(case, limit)
        except AttributeError:
            return None
    return float(limit) if isinstance(limit, int | float) else None


def _page(asked: Asked, study: SweepStudy | None, faults: list[Fault]) -> str:
    calculation = asked.calculation
    case = {} if any(not fault.path for fault in faults) else case_of(calculation, asked.pairs)
    known = {fault.path: fault.message for fault in faults}
    return rendered(
        "vary.html",
        asked.root,
        calculation=calculation,
        path=asked.path,
        case_links=asked.links,
        outdated=asked.outdated,
        links=StudyAddresses(NAME, asked),
        controls=controls(calculation, case, asked.views, known, study.query if study else None),
        hidden=[pair for pair in (*asked.pairs, ("theme", asked.views.get("theme", ""))) if pair[1]],
        faults=[fault for fault in faults if fault.path not in STUDY_NAMES],
        refused=bool(faults),
        theme=asked.views.get("theme", ""),
        study=study,
        studies=studies_of(calculation),
        frames=FRAMES,
    )


def frame(study: SweepStudy, received: ReceivedPoints) -> bytes:
    """The first figure with the points that have come."""
    figure = next(iter(_figures(study, received).values()))
    return rendered(
        "frame.html", study.asked.root, chart=embedded("", figure, study.asked.theme), received=received
    ).encode()


def whole(study: SweepStudy, received: ReceivedPoints) -> bytes:
    """Every figure, every point with a link to its case, and what was said of them."""
    figures = _figures(study, received)
    charts = [embedded(name, figure, study.asked.theme) for name, figure in figures.items()]
    charts[0] = replace(charts[0], study=_points(study, received, next(iter(figures.values()))))
    return rendered(
        "whole.html",
        study.asked.root,
        charts=charts,
        links=study.links,
        formats=IMAGE_FORMATS,
        received=received,
        study=study,
        rows=[_row(study, received, index) for index in range(min(received.done, MOST_ROWS))],
        more=max(received.done - MOST_ROWS, 0),
    ).encode()


def file(study: SweepStudy, received: ReceivedPoints, name: str, image_format: Format) -> bytes:
    """One figure as a file; the study has it."""
    figure = _figures(study, received)[name]
    return table(figure) if image_format == "csv" else written(figure, image_format, study.asked.theme or "light")


def _figures(study: SweepStudy, received: ReceivedPoints) -> dict[str, Figure]:
    return figures_of(grid_of(study.query, study.sweep, received, study.limit))


def _row(study: SweepStudy, received: ReceivedPoints, index: int) -> dict[str, Any]:
    at = study.sweep.points.overrides(index).values()
    return {
        "at": [shown(each, 6) for each in at],
        "value": shown(received.out[index]),
        "status": received.status[index].replace("_", " "),
        "said": ", ".join(received.said[index]),
        "address": study.opened(index),
    }


def _points(study: SweepStudy, received: ReceivedPoints, figure: Figure) -> str:
    """What the script needs to tell the point under the pointer and to open its case."""
    if not all(is_leaf(study.asked.calculation, each.path) for each in study.query.fields):
        return ""
    from app.figures.drawing.image import places  # noqa: PLC0415  only workers draw

    place = places(figure)[0]
    axes = [
        {"path": each.path, "name": each.leaf.title, "unit": each.leaf.unit or "", "at": axis.values}
        for each, axis in zip(study.query.fields, study.sweep.points.axes, strict=True)
    ]
    said = {
        "address": study.asked.root + study.opened(0),
        "axes": axes,
        "out": received.out,
        "title": study.query.output.title,
        "unit": study.query.output.unit or "",
        "map": place.panel.map is not None,
        "box": place.box,
        "ranges": [place.x, place.y],
    }
    return json.dumps(said)
