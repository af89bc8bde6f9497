"""The page that says which input matters: a sensitivity study of a case, its figure, its numbers; runs in workers."""

import json
from dataclasses import dataclass
from typing import Any

from app.contract.fields import Leaf, headlines
from app.figures.data import Axis
from app.figures.influence import Influence, influence
from app.pages.cases import Fault, faults_of
from app.pages.charts import chart_of
from app.pages.links import LONGEST_QUERY
from app.pages.query import body_of, link
from app.pages.templating import rendered
from app.pages.typesetting import shown
from app.pages.vary.controls import output_menu
from app.pages.vary.views import FRAMES
from app.pages.vary.wish import field_at_fault, shown_output
from app.pages.views import REFUSED, Asked
from app.reading import Unreadable
from app.studies.sensitivity import Sensitivity, plan_sensitivity
from app.studies.stream import Line

MOST_ROWS = 40


@dataclass(frozen=True, slots=True)
class Study:
    """A sensitivity study asked for on a page."""

    asked: Asked
    output: Leaf
    sensitivity: Sensitivity


@dataclass(frozen=True, slots=True)
class Opened:
    """A page around its figure; without a study it is whole."""

    head: bytes
    tail: bytes = b""
    status: int = 200
    study: Study | None = None


def opened(asked: Asked, most: int, deadline_s: float) -> Opened:
    """The page of a case's sensitivities, and the study if there is a case."""
    try:
        study = _planned(asked, most, deadline_s) if asked.pairs else None
    except REFUSED as error:
        faults = [Fault(field_at_fault(each.path), each.message) for each in faults_of(error)]
        status = 400 if isinstance(error, Unreadable) else 422
        return Opened(_page(asked, None, faults).encode(), status=status)
    head, _, tail = _page(asked, study, []).partition(FRAMES)
    return Opened(head.encode(), tail.encode(), study=study)


def _planned(asked: Asked, most: int, deadline_s: float) -> Study:
    calculation = asked.calculation
    output = shown_output(calculation, asked.views)
    body = {
        "endpoint": calculation.path,
        "request": body_of(calculation.request, asked.pairs),
        "outputs": [output.path],
    }
    return Study(asked, output, plan_sensitivity(json.dumps(body).encode(), most, deadline_s))


def _page(asked: Asked, study: Study | None, faults: list[Fault]) -> str:
    calculation = asked.calculation
    known = {fault.path: fault.message for fault in faults}
    return rendered(
        "influence.html",
        calculation=calculation,
        path=asked.path,
        case_links=asked.links,
        too_long=asked.links.too_long or len(asked.links.query) > LONGEST_QUERY,
        show=output_menu(calculation, asked.views, known),
        headline=headlines(calculation.response)[0],
        hidden=[pair for pair in (*asked.pairs, ("theme", asked.views.get("theme", ""))) if pair[1]],
        faults=faults,
        theme=asked.views.get("theme", ""),
        study=study,
        frames=FRAMES,
    )


def whole(study: Study, lines: list[Line]) -> bytes:
    """The figure and the numbers; a study that broke off says why."""
    *found, end = lines
    if end["type"] != "end":
        return rendered("influence_result.html", broke=end["message"], chart=None).encode()
    value = end["outputs"][0]["value"]
    inputs = {each["path"]: each for each in end["inputs"]}
    moved = [line for line in found if line["change"] is not None]
    chart = None
    if isinstance(value, int | float):
        axis = Axis(study.output.title, study.output.unit)
        steps = [
            Influence(_name(inputs[line["path"]]), _step(line, inputs), line["change"], bool(line["kink"]))
            for line in moved
        ]
        figure = influence(axis, float(value), steps)
        chart = chart_of("influence", figure, study.asked.theme) if figure.panels else None
    return rendered(
        "influence_result.html",
        broke=None,
        chart=chart,
        status=end["status"],
        value=value,
        output=study.output,
        points=end["points"],
        elapsed_s=end["elapsed_s"],
        rows=[_row(study, line, inputs) for line in moved[:MOST_ROWS]],
        more=max(len(moved) - MOST_ROWS, 0),
    ).encode()


def _name(entry: dict[str, Any]) -> str:
    """Title of an input; which one it is where there are several."""
    place = next((part for part in entry["path"].split(".") if part.isdecimal()), None)
    title = str(entry["title"])
    return title if place is None else f"{title} {int(place) + 1}"


def _step(line: Line, inputs: dict[str, dict[str, Any]]) -> str:
    unit = inputs[line["path"]]["unit"]
    return f"+{shown(line['step'], 3)}{f' {unit}' if unit else ''}"


def _row(study: Study, line: Line, inputs: dict[str, dict[str, Any]]) -> dict[str, Any]:
    entry = inputs[line["path"]]
    said = {"x": line["path"], "show": study.output.path, "theme": study.asked.views.get("theme", "")}
    return {
        "name": _name(entry),
        "value": shown(float(entry["value"])),
        "unit": entry["unit"] or "",
        "step": _step(line, inputs),
        "change": shown(line["change"], 4),
        "elasticity": shown(line["elasticity"], 3),
        "kink": "up and down differ" if line["kink"] else "",
        "address": link(f"{study.asked.path}/vary", study.asked.pairs, **said),
    }
