"""The page of a sensitivity study: a figure and a table of the inputs that change an output most."""

from typing import Any

from app.figures.data import Figure
from app.figures.studies import Influence, influence
from app.figures.units import axis_of
from app.figures.wording import difference_unit, number
from app.models.scuffing.request import GIVEN_BULK
from app.pages.query import link
from app.pages.studies.controls import numbered
from app.pages.studies.page import Link, Number, Result, StudyPage, Table
from app.pages.study_kinds import INFLUENCE, VARY
from app.pages.typesetting import shown
from app.studies.kinds.sensitivity import Sensitivity
from app.studies.runner import Line
from app.studies.tolerances import class_remarks

MOST_ROWS = 40  # largest number of rows of the table, so that a user can read the table; the file has all rows


class SensitivityPage(StudyPage):
    """The page that shows the inputs with the greatest influence on an output."""

    link = INFLUENCE
    question = "which input matters?"
    about = (
        "Every number of the case is lowered and raised by its usual tolerance: slopes of the flanks by that of the "
        "quality class, if any; what has none by 1 % (temperatures by 1 K, whole numbers by 1)."
    )
    figures = ("influence",)
    plan = Sensitivity

    def body(self) -> dict[str, Any]:
        """Return the body of the study: the endpoint, the request of the case, and the output that the page shows."""
        outputs = [self.output.path]
        return {"endpoint": self.calculation.path, "request": self.asked.body, "outputs": outputs}

    def result(self, lines: list[Line]) -> Result:
        """Return the most influential input, a figure and a table of the inputs."""
        end, output = lines[-1], self.output
        inputs = {moved["path"]: moved for moved in end["inputs"]}
        steps, rows = list[Influence](), []
        for line in lines:
            if line["type"] == "sensitivity" and line["range"] is not None:
                path, moved = line["path"], inputs[line["path"]]
                name, unit = numbered(moved["title"], path), moved["unit"] or ""
                step = f"{shown(line['step'], 3)} {difference_unit(unit)}".rstrip()
                varied = {"x": path, "show": output.path, "theme": self.asked.theme}
                row = (
                    Link(name, link(f"{self.asked.path}/{VARY.name}", self.asked.pairs, **varied)),
                    shown(float(moved["value"])),
                    unit,
                    f"±{step}",
                    *(shown(line[name], 4) for name in ("lowered", "raised", "range")),
                    shown(line["elasticity"], 3),
                    _remark(line),
                )
                steps.append(Influence(name, step, line["lowered"], line["raised"], line["range"]))
                rows.append(row)
        value, figures, remarks, answer = end["outputs"][0]["value"], dict[str, Figure](), [], ""
        if not isinstance(value, int | float):
            remarks.append(f"The case has no value of the {output.title}; choose another output.")
        elif (figure := influence(axis_of(output), float(value), steps)).panels:
            figures["influence"] = figure
            most = number(steps[0].range, difference_unit(output.unit))
            answer = f"The {steps[0].name} matters most: over ±{steps[0].step} the {output.title} changes by {most}."
        else:
            remarks.append(f"No input changes the {output.title} of this case.")
        if GIVEN_BULK in {assumption["reason"] for assumption in end["assumptions"]}:
            remarks.append(f"Oil temperature: {GIVEN_BULK}.")
        remarks += [f"{remark}." for remark in class_remarks(end["assumptions"])]
        unit = f", {difference_unit(output.unit)}" if output.unit else ""
        numbers = tuple(map(Number, ("tolerance", f"lowered{unit}", "raised", "range", "% for 1 %")))
        head = ("input", Number("value"), "unit", *numbers, "remark")
        more = len(rows) - MOST_ROWS
        note = (
            "The range is the largest minus the least output over the tolerance, at no, half and whole steps; it also "
            "sees what costs on both sides. Click a name to see the curve over this input."
        )
        note += f" {more} inputs more change it less." if more > 0 else ""
        table = Table(f"Changes of the {output.title}, the most influential input first", head, rows[:MOST_ROWS], note)
        progress = f"{end['points']} cases in {shown(end['elapsed_s'], 2)} s"
        return Result(progress, figures, (table,) if rows else (), tuple(remarks), answer=answer)


def _remark(line: Line) -> str:
    """Say what a single slope hides: the same sign on both sides, or a slope that the step changes."""
    lowered, raised = line["lowered"], line["raised"]
    if lowered and raised and (lowered < 0.0) == (raised < 0.0):
        return "both ways lower it" if raised < 0.0 else "both ways raise it"
    return "up and down differ" if line["kink"] else "half a step differs" if line["curved"] else ""
