"""Sensitivity: the inputs of a case sorted by what they change, as a figure and a table."""

from typing import Any

from app.figures.data import Figure
from app.figures.studies import Influence, influence
from app.figures.units import axis_of
from app.figures.wording import difference_unit
from app.pages import study_links
from app.pages.query import link
from app.pages.studies.page import Link, Number, Result, StudyPage, Table
from app.pages.studies.sweep import numbered
from app.pages.typesetting import shown
from app.schema.scuffing import GIVEN_BULK
from app.studies.engine import Line
from app.studies.sensitivity import Sensitivity

MOST_ROWS = 40  # of a table that can be read; the file has all


class SensitivityPage(StudyPage):
    """Which inputs change an output most."""

    link = study_links.SENSITIVITY
    question = "which input matters?"
    about = "Every number of the case is moved by its usual tolerance, else by 1 % (1 K, 1)."
    figures = ("influence",)
    plan = Sensitivity

    def body(self) -> dict[str, Any]:
        """The request of the case, and the output that is shown."""
        outputs = [self.output.path]
        return {"endpoint": self.calculation.path, "request": self.asked.body, "outputs": outputs}

    def result(self, lines: list[Line]) -> Result:
        """The change of the output by one step of each input, largest first, as a bar chart and a table."""
        end, output = lines[-1], self.output
        inputs = {each["path"]: each for each in end["inputs"]}
        steps, rows = list[Influence](), []
        for line in lines:
            if line["type"] == "sensitivity" and line["change"] is not None:
                path, known = line["path"], inputs[line["path"]]
                name, unit = numbered(known["title"], path), known["unit"] or ""
                step = f"+{shown(line['step'], 3)} {difference_unit(unit)}".rstrip()
                varied = {"x": path, "show": output.path, "theme": self.asked.theme}
                row = (
                    Link(name, link(f"{self.asked.path}/vary", self.asked.pairs, **varied)),
                    shown(float(known["value"])),
                    unit,
                    step,
                    shown(line["change"], 4),
                    shown(line["elasticity"], 3),
                    "up and down differ" if line["kink"] else "half a step differs" if line["curved"] else "",
                )
                steps.append(Influence(name, step, line["change"], bool(line["kink"])))
                rows.append(row)
        value, figures, remarks = end["outputs"][0]["value"], dict[str, Figure](), []
        if not isinstance(value, int | float):
            remarks.append(f"The case has no {output.title}, so nothing moves it.")
        elif (figure := influence(axis_of(output), float(value), steps)).panels:
            figures["influence"] = figure
        else:
            remarks.append(f"No input moves the {output.title} of this case.")
        if GIVEN_BULK in {each["reason"] for each in end["assumptions"]}:
            remarks.append(f"Oil temperature: {GIVEN_BULK}.")
        changes = f"changes the {output.title} by{f', {difference_unit(output.unit)}' if output.unit else ''}"
        head = ("input", Number("value"), "unit", Number("one step"), Number(changes), Number("% for 1 %"), "remark")
        more = len(rows) - MOST_ROWS
        note = "A name leads to the curve over that input."
        note += f" {more} inputs more change it less." if more > 0 else ""
        table = Table("Inputs, the most influential first", head, rows[:MOST_ROWS], note)
        progress = f"{end['points']} cases in {shown(end['elapsed_s'], 2)} s"
        return Result(progress, figures, (table,) if rows else (), tuple(remarks))
