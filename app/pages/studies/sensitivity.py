"""Sensitivity: the inputs of a case sorted by what they change, as a figure and a table."""

from typing import Any

from app.figures.studies import Influence, influence
from app.figures.units import axis_of
from app.pages import study_links
from app.pages.query import link
from app.pages.studies.declaration import Link, Number, PageStudy, Result, StudyPage, Table
from app.pages.studies.sweep import numbered
from app.pages.typesetting import shown
from app.pages.views import Asked
from app.schema.fields import Leaf
from app.schema.scuffing import GIVEN_BULK
from app.studies.engine import Line
from app.studies.sensitivity import Sensitivity

MOST_ROWS = 40  # of a table that can be read; the file has all


def _body(asked: Asked, output: Leaf) -> dict[str, Any]:
    return {"endpoint": asked.calculation.path, "request": asked.body, "outputs": [output.path]}


def _result(study: PageStudy, lines: list[Line]) -> Result:
    """Bars and a table, the most influential input first."""
    *found, end = (line for line in lines if line["type"] in {"sensitivity", "end"})
    value, output = end["outputs"][0]["value"], study.output
    inputs = {each["path"]: each for each in end["inputs"]}
    moved = [inputs[line["path"]] | line for line in found if line["change"] is not None]
    figures, remarks = {}, []
    if isinstance(value, int | float):
        steps = [Influence(_name(line), _step(line), line["change"], bool(line["kink"])) for line in moved]
        figure = influence(axis_of(output), float(value), steps)
        if figure.panels:
            figures["influence"] = figure
        else:
            remarks.append(f"No input moves the {output.title} of this case.")
    else:
        remarks.append(f"The case has no {output.title}, so nothing moves it.")
    if GIVEN_BULK in {each["reason"] for each in end["assumptions"]}:
        remarks.append(f"Oil temperature: {GIVEN_BULK}.")
    progress = f"{end['points']} cases in {shown(end['elapsed_s'], 2)} s"
    return Result(progress, figures, (_table(study, moved),) if moved else (), tuple(remarks))


def _name(line: Line) -> str:
    return numbered(line["title"], line["path"])


def _step(line: Line) -> str:
    return f"+{shown(line['step'], 3)}" + (f" {line['unit']}" if line["unit"] else "")


def _table(study: PageStudy, moved: list[Line]) -> Table:
    output, asked, more = study.output, study.asked, len(moved) - MOST_ROWS
    rows = []
    for line in moved[:MOST_ROWS]:
        varied = {"x": line["path"], "show": output.path, "theme": asked.views.get("theme", "")}
        row = (
            Link(_name(line), link(f"{asked.path}/vary", asked.pairs, **varied)),
            shown(float(line["value"])),
            line["unit"] or "",
            _step(line),
            shown(line["change"], 4),
            shown(line["elasticity"], 3),
            "up and down differ" if line["kink"] else "half a step differs" if line["curved"] else "",
        )
        rows.append(row)
    changes = f"changes the {output.title} by{f', {output.unit}' if output.unit else ''}"
    return Table(
        "Inputs, the most influential first",
        ("input", Number("value"), "unit", Number("one step"), Number(changes), Number("% for 1 %"), "remark"),
        tuple(rows),
        "A name leads to the curve over that input." + (f" {more} inputs more change it less." if more > 0 else ""),
    )


SENSITIVITY = StudyPage(
    link=study_links.SENSITIVITY,
    question="which input matters?",
    about="Every number of the case is moved by its usual tolerance, else by 1 % (1 K, 1).",
    figures=("influence",),
    body=_body,
    plan=Sensitivity,
    result=_result,
)
