"""Corners: an output over every combination of the uncertain inputs of a unit, and the load at the worst one."""

from dataclasses import replace
from functools import cached_property
from typing import Any

from app.figures.comparison import compared
from app.figures.data import Figure, Hue, NoFigure, Row
from app.figures.models.drive_train import LOAD_ALONE
from app.figures.studies import corners
from app.figures.units import axis_of
from app.figures.wording import listed, number
from app.pages import study_links
from app.pages.cases import REFUSED, Case
from app.pages.query import CORNER
from app.pages.studies.page import Controls, Link, Number, Result, StudyPage, Table, titled
from app.pages.studies.sweep import numbered
from app.pages.typed import number_of, text_of
from app.pages.typesetting import shown
from app.schema.fields import headlines
from app.studies.engine import Line
from app.studies.fields import value_at
from app.studies.point_sets import usual_corners
from app.studies.points import COLD, BaseRequest, needs_film
from app.studies.requests import DRIVE_TRAIN, USUAL_RANGES, Axis, Overrides
from app.studies.sweep import Corners


class UnitPage(StudyPage):
    """A study over the corners of a gear unit, which are the member `corners` of its body.

    The uncertain inputs in `left_alone` are as in the case where nothing is typed.
    """

    outputs = ("safety.blok_flank",)
    corners = "corners"
    left_alone: tuple[str, ...] = ()

    @cached_property
    def uncertain(self) -> dict[str, Axis]:
        """The uncertain inputs with their usual values, by quantity; empty where the case is refused."""
        try:
            return usual_corners(BaseRequest(self.calculation, self.asked.body).checked({}))
        except REFUSED:
            return {}

    def ranges(self) -> dict[str, dict[str, Any]]:
        """The values of the uncertain inputs as typed, else the usual ones, by the names of their controls."""
        found = {}
        for quantity, axis in self.uncertain.items():
            values, name = axis.values, _control(quantity)
            if text := self.views.get(name):
                rows = [[number_of(each) for each in row.split()] for row in text.split(";")]
                values = [row[0] if len(row) == 1 else row for row in rows]
            elif quantity in self.left_alone:
                continue
            found[name] = {"path": axis.path, "values": values}
        return found

    def controls(self) -> tuple[Controls, ...]:
        """A field for the values of each uncertain input."""
        fields = []
        for quantity, axis in self.uncertain.items():
            rows = [row if isinstance(row, list) else [row] for row in axis.values or ()]
            text = "; ".join(" ".join(map(text_of, row)) for row in rows)
            label = titled(replace(self.input(axis.paths[0]), title=quantity))
            usual = "as in the case" if quantity in self.left_alone else text
            fields.append(self.field(_control(quantity), label, usual))
        about = "Values with semicolons between; blanks between inputs that move together."
        return (Controls("Uncertain inputs", fields=tuple(fields), about=about),)

    def places(self) -> dict[str, str]:
        """The control of each uncertain input; faults of all inputs together are shown at the first."""
        names = list(self.ranges())
        places = {f"{self.corners}.{place}": name for place, name in enumerate(names)}
        return {self.corners: names[0], **places} if names else {}

    def corner_table(self, title: str, case: Case, corner: Overrides) -> Table:
        """What a corner changes in the case."""
        rows = []
        for path, value in corner.items():
            leaf = self.input(path)
            described = shown(value_at(case.response.inputs, path))
            rows.append((numbered(leaf.title, path), described, shown(value), leaf.unit or ""))
        return Table(title, ("input", Number("as described"), Number("there"), "unit"), rows)


def _control(quantity: str) -> str:
    """The control of an uncertain input."""
    return f"{CORNER}{quantity.replace(' ', '_')}"


def load_figure(case: Case, reference: Case, name: str, finding: str) -> dict[str, Figure]:
    """Load along the face at a corner (solid) and for the case as entered (dashed); None where there is no load."""
    try:
        own, given = (LOAD_ALONE.figure(each.request, each.response) for each in (case, reference))
    except NoFigure:
        return {}
    (panel,) = compared(own, given, "as described").panels
    line, *dashed = panel.lines
    panel = replace(panel, lines=(replace(line, title=name), *(replace(each, title="as described") for each in dashed)))
    return {LOAD_ALONE.name: replace(own, finding=f"{finding}{own.finding}, dashed {given.finding}", panels=(panel,))}


class CornersPage(UnitPage):
    """The worst corner of a gear unit."""

    link = study_links.CORNERS
    question = "which corner is worst?"
    about = f"Every combination of the uncertain inputs: {USUAL_RANGES}."
    figures = ("corners", LOAD_ALONE.name)
    corners = "ranges"
    plan = Corners
    study: Corners

    def body(self) -> dict[str, Any]:
        """The corners as typed or usual; outputs are the one shown and the headlines that need no thermal film."""
        output, paths = self.output.path, [leaf.path for leaf in headlines(self.calculation.response)]
        deciding = [path for path in paths if not (needs_film(DRIVE_TRAIN, path) or path.startswith(COLD))]
        return {
            "request": self.asked.body,
            "ranges": list(self.ranges().values()) or None,
            "outputs": list(dict.fromkeys([output, *deciding])),
        }

    def result(self, lines: list[Line]) -> Result:
        """The effect of each uncertain input, and the load at the worst corner beside that of the case."""
        end, output = lines[-1], self.output
        extremes = {line["output"]: line for line in lines if line["type"] == "extremes"}
        progress = f"{end['points']} corners in {shown(end['elapsed_s'], 2)} s"
        remarks = [warning["message"] for warning in end["warnings"]]
        if output.path not in extremes:
            remarks.append(f"No corner has a {output.title}; choose another output.")
            return Result(progress, remarks=tuple(remarks))
        worst = extremes[output.path]["min" if output.view.greatest_is_best else "max"]["at"]
        case, other = self.solved({}), self.solved(worst)
        found = corners(axis_of(output), self._rows(lines, worst), value_at(case.response, output.path))
        load = load_figure(other, case, "worst corner", "worst corner and, dashed, as described: ")
        leads = (
            Link("Open the worst corner", self.address(worst)),
            Link("Its report", self.address(worst, "/report")),
            Link("What to grind", self.asked.study(study_links.DESIGN.name)),
        )
        tables = (self._extremes(extremes, case), self.corner_table("The worst corner", case, worst))
        return Result(progress, {"corners": found, **load}, tables, tuple(remarks), leads)

    def _rows(self, lines: list[Line], worst: Overrides) -> list[Row]:
        """For each value of each uncertain input, the worst output among the corners with that value."""
        points = [line for line in lines if line["type"] == "point" and line["out"][0] is not None]
        pick = min if self.output.view.greatest_is_best else max
        found = []
        for place, axis in enumerate(self.study.points.axes):
            dots = []
            for value in axis.values or ():
                each = value if isinstance(value, list) else [value] * len(axis.leaves)
                texts = [number(own) if isinstance(own, int | float) else str(own) for own in each]
                text = ", ".join(texts[:1] if len(set(each)) == 1 else texts)
                if unit := axis.header()["unit"]:
                    text = f"{text} {unit}"
                decides = [worst[leaf.path] for leaf in axis.leaves] == each
                if known := [line["out"][0] for line in points if line["at"][place] == value]:
                    dots.append(Row(text, pick(known), Hue.VERMILLION if decides else Hue.BLUE))
            titles = dict.fromkeys(leaf.title for leaf in axis.leaves)
            found.append(Row(listed(list(titles)), pick(dot.value for dot in dots), dots=dots))
        return found

    def _extremes(self, extremes: dict[str, Line], case: Case) -> Table:
        """The least and the largest value of each output, each a link to the case at its corner."""
        rows = []
        for leaf in self.study.outputs:
            if leaf.path in extremes:
                ends = [extremes[leaf.path][end] for end in ("min", "max")]
                least, largest = (Link(shown(end["value"]), self.address(end["at"])) for end in ends)
                rows.append((leaf.title, shown(value_at(case.response, leaf.path)), least, largest, leaf.unit or ""))
        head = ("output", Number("as described"), Number("least"), Number("largest"), "unit")
        return Table("Over all corners", head, rows, "A number leads to the case at its corner.")
