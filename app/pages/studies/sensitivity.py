"""Sensitivity: the inputs of a case sorted by what they change, as a figure and a table."""

from typing import Any

from app.figures.studies import Influence, influence
from app.figures.units import axis_of
from app.pages import study_links
from app.pages.query import link
from app.pages.studies.declaration import Link, Number, PageStudy, Result, StudyPage, Table, numbered
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
        "request": asked.body,
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
        names = [numbered(inputs[line["path"]]["title"], line["path"]) for line in moved]
        steps = [
            Influence(name, _step(line, inputs), line["change"], bool(line["kink"]))
            for name, line in zip(names, moved, strict=True)
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
        head=("input", Number("value"), "unit", Number("one step"), Number(changes), Number("% for 1 %"), "remark"),
        rows=tuple(_row(study, line, inputs) for line in moved[:MOST_ROWS]),
        note="A name leads to the curve over that input." + (f" {more} inputs more change it less." if more else ""),
    )


def _step(line: Line, inputs: dict[str, dict[str, Any]]) -> str:
    unit = inputs[line["path"]]["unit"]
    return f"+{shown(line['step'], 3)}{f' {unit}' if unit else ''}"


def _row(study: PageStudy, line: Line, inputs: dict[str, dict[str, Any]]) -> tuple[str | Link, ...]:
    entry, asked = inputs[line["path"]], study.asked
    sweep = {"x": line["path"], "show": study.output.path, "theme": asked.views.get("theme", "")}
    return (
        Link(numbered(entry["title"], entry["path"]), link(f"{asked.path}/vary", asked.pairs, **sweep)),
        shown(float(entry["value"])),
        entry["unit"] or "",
        _step(line, inputs),
        shown(line["change"], 4),
        shown(line["elasticity"], 3),
        "up and down differ" if line["kink"] else "half a step differs" if line["curved"] else "",
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
