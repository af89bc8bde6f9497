"""Sensitivity: the inputs of a case sorted by what they change, as a figure and a table."""

from typing import Any

from app.figures.data import Figure
from app.figures.studies import Influence, influence
from app.figures.units import axis_of
from app.pages import study_links
from app.pages.query import link
from app.pages.studies.page import Link, Number, Result, StudyPage, Table
from app.pages.studies.sweep import numbered
from app.pages.typesetting import shown
from app.schema.scuffing import GIVEN_BULK
from app.studies.engine import Line
from app.studies.sensitivity import sensitivity_study

MOST_ROWS = 40  # of a table that can be read; the file has all


class SensitivityPage(StudyPage):
    """What moves an output most."""

    link = study_links.SENSITIVITY
    question = "which input matters?"
    about = "Every number of the case is moved by its usual tolerance, else by 1 % (1 K, 1)."
    figures = ("influence",)
    plan = staticmethod(sensitivity_study)

    def body(self) -> dict[str, Any]:
        """The case and the output shown."""
        return {"endpoint": self.calculation.path, "request": self.asked.body, "outputs": [self.output.path]}

    def result(self, lines: list[Line]) -> Result:
        """Bars and a table, the most influential input first."""
        end, title = lines[-1], self.output.title
        inputs = {each["path"]: each for each in end["inputs"]}
        found = (line for line in lines if line["type"] == "sensitivity" and line["change"] is not None)
        moved = [inputs[line["path"]] | line for line in found]
        value, figures, remarks = end["outputs"][0]["value"], dict[str, Figure](), []
        if isinstance(value, int | float):
            steps = [Influence(_name(line), _step(line), line["change"], bool(line["kink"])) for line in moved]
            figure = influence(axis_of(self.output), float(value), steps)
            if figure.panels:
                figures["influence"] = figure
            else:
                remarks.append(f"No input moves the {title} of this case.")
        else:
            remarks.append(f"The case has no {title}, so nothing moves it.")
        if GIVEN_BULK in {each["reason"] for each in end["assumptions"]}:
            remarks.append(f"Oil temperature: {GIVEN_BULK}.")
        progress = f"{end['points']} cases in {shown(end['elapsed_s'], 2)} s"
        return Result(progress, figures, (self._table(moved),) if moved else (), tuple(remarks))

    def _table(self, moved: list[Line]) -> Table:
        output, more = self.output, len(moved) - MOST_ROWS
        rows = []
        for line in moved[:MOST_ROWS]:
            varied = {"x": line["path"], "show": output.path, "theme": self.asked.views.get("theme", "")}
            row = (
                Link(_name(line), link(f"{self.asked.path}/vary", self.asked.pairs, **varied)),
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
            rows,
            "A name leads to the curve over that input." + (f" {more} inputs more change it less." if more > 0 else ""),
        )


def _name(line: Line) -> str:
    return numbered(line["title"], line["path"])


def _step(line: Line) -> str:
    return f"+{shown(line['step'], 3)}" + (f" {line['unit']}" if line["unit"] else "")
