"""Sensitivity: the inputs of a case sorted by what they change, as a figure and a table."""

from typing import Any

from app.figures.studies import Influence, influence
from app.figures.units import axis_of
from app.pages import study_links
from app.pages.query import body_of, link
from app.pages.studies.declaration import Cell, PageStudy, Result, StudyPage, Table
from app.pages.typesetting import shown
from app.pages.views import Asked
from app.schema.fields import Leaf
from app.schema.scuffing import GIVEN_BULK
from app.studies.engine import Line
from app.studies.sensitivity import sensitivity_study

MOST_ROWS = 40  # of a table that can be read; the file has all


def _body(asked: Asked, output: Leaf) -> dict[str, Any]:
    calculation = asked.calculation
    return {
        "endpoint": calculation.path,
        "request": body_of(calculation.request, asked.pairs),
        "outputs": [output.path],
    }


def _result(study: PageStudy, lines: list[Line]) -> Result:
    """Bars and a table, the most influential input first."""
    *found, end = (line for line in lines if line["type"] in {"sensitivity", "end"})
    value, output = end["outputs"][0]["value"], study.output
    inputs = {each["path"]: each for each in end["inputs"]}
    moved = [line for line in found if line["change"] is not None]
    progress = f"{end['points']} cases in {shown(end['elapsed_s'], 2)} s"
    figures, remarks = {}, []
    if isinstance(value, int | float):
        steps = [
            Influence(_name(inputs[line["path"]]), _step(line, inputs), line["change"], bool(line["kink"]))
            for line in moved
        ]
        figure = influence(axis_of(output), float(value), steps)
        if figure.panels:
            figures["influence"] = figure
        else:
            remarks.append(f"No input moves the {output.title} of this case.")
    else:
        remarks.append(f"The case has no {output.title}, so nothing moves it.")
    if GIVEN_BULK in {each["reason"] for each in end["assumptions"]}:
        remarks.append(f"Oil temperature: {GIVEN_BULK}.")
    tables = (_table(study, moved, inputs),) if moved else ()
    return Result(progress, figures, tables, tuple(remarks))


def _table(study: PageStudy, moved: list[Line], inputs: dict[str, dict[str, Any]]) -> Table:
    output, more = study.output, max(len(moved) - MOST_ROWS, 0)
    changes = f"changes the {output.title} by{f', {output.unit}' if output.unit else ''}"
    return Table(
        title="Inputs, the most influential first",
        head=(
            Cell("input"),
            Cell("value", right=True),
            Cell("unit"),
            Cell("one step", right=True),
            Cell(changes, right=True),
            Cell("% for 1 %", right=True),
            Cell("remark"),
        ),
        rows=tuple(_row(study, line, inputs) for line in moved[:MOST_ROWS]),
        note="A name leads to the curve over that input." + (f" {more} inputs more change it less." if more else ""),
    )


def _name(entry: dict[str, Any]) -> str:
    """Title of an input; which one it is where there are several."""
    place = next((part for part in entry["path"].split(".") if part.isdecimal()), None)
    title = str(entry["title"])
    return title if place is None else f"{title} {int(place) + 1}"


def _step(line: Line, inputs: dict[str, dict[str, Any]]) -> str:
    unit = inputs[line["path"]]["unit"]
    return f"+{shown(line['step'], 3)}{f' {unit}' if unit else ''}"


def _row(study: PageStudy, line: Line, inputs: dict[str, dict[str, Any]]) -> tuple[Cell, ...]:
    entry, asked = inputs[line["path"]], study.asked
    sweep = {"x": line["path"], "show": study.output.path, "theme": asked.views.get("theme", "")}
    return (
        Cell(_name(entry), link(f"{asked.path}/vary", asked.pairs, **sweep)),
        Cell(shown(float(entry["value"])), right=True),
        Cell(entry["unit"] or ""),
        Cell(_step(line, inputs), right=True),
        Cell(shown(line["change"], 4), right=True),
        Cell(shown(line["elasticity"], 3), right=True),
        Cell("up and down differ" if line["kink"] else "half a step differs" if line["curved"] else ""),
    )


SENSITIVITY = StudyPage(
    link=study_links.SENSITIVITY,
    question="which input matters?",
    about="Every number of the case is moved by its usual tolerance, else by 1 % (1 K, 1).",
    figures=("influence",),
    body=_body,
    plan=sensitivity_study,
    result=_result,
)
