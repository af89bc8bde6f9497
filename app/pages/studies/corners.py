"""The page of a gear unit's corners: the effect of each uncertain input, and the load along the face at the worst."""

from functools import cached_property
from typing import Any

from app.figures.data import Hue, Row
from app.figures.studies import corners
from app.figures.units import axis_of
from app.figures.wording import listed, number
from app.models.drive_train.figures import LOAD_ALONE
from app.pages.cases import REFUSED, SolvedCase
from app.pages.studies.page import Link, Number, Result, Table
from app.pages.studies.unit import UnitPage, load_figure
from app.pages.study_kinds import CORNERS, DESIGN
from app.pages.typesetting import shown
from app.schema.fields import headlines, value_at
from app.studies.kinds.corners import USUAL_RANGES, Corners
from app.studies.points import COLD, BaseRequest, needs_film
from app.studies.requests import DRIVE_TRAIN, Axis, Overrides
from app.studies.runner import Line
from app.studies.tolerances import class_corners, class_remarks


class CornersPage(UnitPage):
    """The page that shows the worst corner of a gear unit."""

    link = CORNERS
    question = "which corner is worst?"
    about = f"The result is calculated for every combination of the uncertain inputs: {USUAL_RANGES}."
    figures = ("corners", LOAD_ALONE.name)
    corners = "ranges"
    plan = Corners
    study: Corners

    @cached_property
    def uncertain(self) -> dict[str, Axis]:
        """The uncertain inputs, and the slopes of the flanks if the gears have a quality class."""
        try:
            by_class = class_corners(BaseRequest(self.calculation, self.asked.body).checked({}))
        except REFUSED:
            by_class = {}
        return super().uncertain | by_class

    def body(self) -> dict[str, Any]:
        """Return the body of the request for the study."""
        output, paths = self.output.path, [leaf.path for leaf in headlines(self.calculation.response)]
        deciding = [path for path in paths if not (needs_film(DRIVE_TRAIN, path) or path.startswith(COLD))]
        return {
            "request": self.asked.body,
            **self.given(),
            "outputs": list(dict.fromkeys([output, *deciding])),
        }

    def result(self, lines: list[Line]) -> Result:
        """Return two figures and two tables."""
        end, output = lines[-1], self.output
        extremes = {line["output"]: line for line in lines if line["type"] == "extremes"}
        progress = f"{end['points']} corners in {shown(end['elapsed_s'], 2)} s"
        remarks = [warning["message"] for warning in end["warnings"]]
        remarks += [f"{remark}." for remark in class_remarks(end["assumptions"])]
        if output.path not in extremes:
            remarks.append(f"No corner has a value of the {output.title}; choose another output.")
            return Result(progress, remarks=tuple(remarks))
        worst = extremes[output.path]["min" if output.view.greatest_is_best else "max"]["at"]
        case, worst_case = self.solved({}), self.solved(worst)
        figure = corners(axis_of(output), self._rows(lines, worst), value_at(case.response, output.path))
        load = load_figure(worst_case, case, "worst corner", "worst corner and, dashed, as described: ")
        leads = (
            Link("Open the worst corner", self.address(worst)),
            Link("Its report", self.address(worst, "/report")),
            Link("What to grind", self.asked.study(DESIGN.name)),
        )
        tables = (self._extremes(extremes, case), self.corner_table("The worst corner", case, worst))
        return Result(progress, {"corners": figure, **load}, tables, tuple(remarks), leads)

    def _rows(self, lines: list[Line], worst: Overrides) -> list[Row]:
        """Return one row of a dot plot per uncertain input, with one dot per value of the input."""
        points = [line for line in lines if line["type"] == "point" and line["out"][0] is not None]
        pick = min if self.output.view.greatest_is_best else max
        rows = []
        for place, axis in enumerate(self.study.points.axes):
            dots = []
            for value in axis.values or ():
                per_field = value if isinstance(value, list) else [value] * len(axis.leaves)
                texts = [number(own) if isinstance(own, int | float) else str(own) for own in per_field]
                text = ", ".join(texts[:1] if len(set(per_field)) == 1 else texts)
                if unit := axis.header()["unit"]:
                    text = f"{text} {unit}"
                is_worst = [worst[leaf.path] for leaf in axis.leaves] == per_field
                if outputs := [line["out"][0] for line in points if line["at"][place] == value]:
                    dots.append(Row(text, pick(outputs), Hue.VERMILLION if is_worst else Hue.BLUE))
            titles = dict.fromkeys(leaf.title for leaf in axis.leaves)
            rows.append(Row(listed(list(titles)), pick(dot.value for dot in dots), dots=dots))
        return rows

    def _extremes(self, extremes: dict[str, Line], case: SolvedCase) -> Table:
        """Return a table of the least and the largest value of each output."""
        rows = []
        for leaf in self.study.outputs:
            if leaf.path in extremes:
                ends = [extremes[leaf.path][end] for end in ("min", "max")]
                least, largest = (Link(shown(end["value"]), self.address(end["at"])) for end in ends)
                rows.append((leaf.title, shown(value_at(case.response, leaf.path)), least, largest, leaf.unit or ""))
        head = ("output", Number("as described"), Number("least"), Number("largest"), "unit")
        return Table("Over all corners", head, rows, "Click a number to open the case at its corner.")
