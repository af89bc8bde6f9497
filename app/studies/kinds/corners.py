"""Corners: a sweep over all combinations of the values of a gear unit's uncertain inputs.

A corner is one of these combinations. The page shows two things: the effect of each uncertain input on an output, and
the load along the face at the worst corner.
"""

from dataclasses import replace
from functools import cached_property, partial
from typing import Annotated, Any, ClassVar

from app.errors import Unprocessable
from app.figures.comparison import compared
from app.figures.data import Figure, Hue, NoFigure, Row
from app.figures.studies import corners
from app.figures.units import axis_of
from app.figures.wording import listed, number
from app.models.drive_train.figures import LOAD_ALONE
from app.pages.cases import REFUSED, Case
from app.pages.query import CORNER
from app.pages.studies.controls import Control, numbered
from app.pages.studies.page import Controls, Link, Number, Result, StudyPage, Table, titled
from app.pages.study_kinds import StudyLink
from app.pages.typed import number_of, text_of
from app.pages.typesetting import shown
from app.schema.fields import headlines
from app.schema.quantities import Input
from app.studies.fields import value_at
from app.studies.kinds.sweep import Summary, Sweep
from app.studies.point_sets import PointSet, grid, usual_corners
from app.studies.points import COLD, SOLVED, BaseRequest, needs_film
from app.studies.requests import (
    DRIVE_TRAIN,
    RANGES,
    Axis,
    DriveTrainStudy,
    FromIndex,
    Outputs,
    Overrides,
    Ranges,
)
from app.studies.runner import Line
from solvers.drive_train.uncertainty import MOST_CORNERS, no_convergence

USUAL_RANGES = (
    "wall response, clearances of a shaft's plain bearings against each other, friction, direction of the offset and "
    "thrust of the couplings"
)
UNCERTAIN = ("wall response", "pinion clearance", "wheel clearance", "friction", "offset", "thrust fraction")
"""The inputs of a gear unit that can be uncertain."""
DESIGN = "design"
"""Name of the study page that searches for the flank correction with the best result at its worst corner."""


class CornersRequest(DriveTrainStudy):
    """A gear unit, and the ranges of its uncertain inputs."""

    sample: ClassVar[None] = None
    best: ClassVar[None] = None

    ranges: Annotated[Ranges, Input("ranges", text=RANGES, default_text=USUAL_RANGES)] = None
    outputs: Outputs = None
    from_index: FromIndex = 0


class Corners(Sweep):
    """Study of a gear unit at every corner, for at most 256 corners.

    A corner is a combination of the values of the uncertain inputs. The answer has one line of text per corner, and one
    line of the type `extremes` per output with the least and the largest value of this output.

    The thermal film is calculated only if an output needs this film. Without the film, the study is twenty times as
    fast and has fewer warnings. If a corner has no solution, its line states the reason, and the last line of the
    answer has the warning `no_convergence_of_corner`.
    """

    path = "/v1/drive-train/corners"
    summary = "A gear unit at every combination of its uncertain inputs"
    answer = "a line for the ranges, each corner, the extremes of each output, and one for the end"
    model = CornersRequest
    is_reduced = True

    def _points(self, base: BaseRequest, most: int) -> PointSet:
        ranges: list[Axis] | None = self.body.ranges
        if ranges is None:
            ranges = list(usual_corners(base.checked({})).values())
        if not ranges:
            raise Unprocessable(
                "no_corners",
                "no input of this gear unit is uncertain; list the uncertain inputs in the field 'ranges'",
                "ranges",
            )
        return grid(ranges, base, min(most, MOST_CORNERS), "ranges")

    def _closing(self, summary: Summary, end: Line) -> list[Line]:
        """Return the last lines of the answer: one line `extremes` per output, and the line `end`.

        The line `end` has a warning if some corners have no solution.
        """
        extremes: list[Line] = []
        for path, extreme in summary.extremes.items():
            ends = {name: {"value": value, "at": self.points.overrides(at)} for name, (value, at) in extreme.items()}
            extremes.append({"type": "extremes", "output": path, **ends})
        unsolved = self.total - sum(summary.counts[status] for status in SOLVED)
        notice = no_convergence(unsolved)
        warning = {"rank": notice.rank, "code": notice.code, "message": notice.message}
        return [*extremes, {**end, "warnings": [warning] if unsolved else []}]


def control_of(quantity: str) -> str:
    """Return the name of the form control for an uncertain input."""
    return f"{CORNER}{quantity.replace(' ', '_')}"


class UnitPage(StudyPage):
    """Base class of the pages of studies that vary the uncertain inputs of a gear unit.

    `corners` is the field of the request that contains the values of the uncertain inputs. `left_alone` lists inputs
    that are varied only if the user types values for them.
    """

    names = frozenset(map(control_of, UNCERTAIN))
    outputs = ("safety.blok_flank",)
    corners = "corners"
    left_alone: tuple[str, ...] = ()

    @cached_property
    def uncertain(self) -> dict[str, Axis]:
        """Study axes with the usual values of the uncertain inputs; the keys are the names of the inputs.

        The dictionary is empty if the request is invalid.
        """
        try:
            return usual_corners(BaseRequest(self.calculation, self.asked.body).checked({}))
        except REFUSED:
            return {}

    def declared(self) -> tuple[Control, ...]:
        """Return one form control per uncertain input, in which the user types the values of this input.

        By default, a control contains the usual values of its input. The controls of the inputs in `left_alone` are
        empty by default. Errors that concern all uncertain inputs together are shown at the first control.
        """
        controls: list[Control] = []
        for quantity, axis in self.uncertain.items():
            name = control_of(quantity)
            usual = None if quantity in self.left_alone else {"path": axis.path, "values": axis.values}
            if usual or self.views.get(name):
                controls.append(Control(name, f"{self.corners}.{len(controls)}", usual, partial(_typed, axis)))
        return (*(Control(first.name, self.corners, sets=False) for first in controls[:1]), *controls)

    def controls(self) -> tuple[Controls, ...]:
        """Return a group with one form field per uncertain input, for the values of this input."""
        fields = []
        for quantity, axis in self.uncertain.items():
            rows = [row if isinstance(row, list) else [row] for row in axis.values or ()]
            text = "; ".join(" ".join(map(text_of, row)) for row in rows)
            label = titled(replace(self.input(axis.paths[0]), title=quantity))
            usual = "as in the case" if quantity in self.left_alone else text
            fields.append(self.field(control_of(quantity), label, usual))
        about = (
            "Write semicolons between the values. If several inputs change together, write blanks between their values."
        )
        return (Controls("Uncertain inputs", fields=tuple(fields), about=about),)

    def corner_table(self, title: str, case: Case, corner: Overrides) -> Table:
        """Return a table of the inputs that a corner changes.

        The table contains the values as described by the user and the values at the corner.
        """
        rows = []
        for path, value in corner.items():
            leaf = self.input(path)
            described = shown(value_at(case.response.inputs, path))
            rows.append((numbered(leaf.title, path), described, shown(value), leaf.unit or ""))
        return Table(title, ("input", Number("as described"), Number("there"), "unit"), rows)


def _typed(axis: Axis, text: str) -> dict[str, Any]:
    """Return the path of an uncertain input, and the values that the user typed for this input.

    Semicolons separate the values. If several fields change together, blanks separate the values of these fields.
    """
    rows = [[number_of(part) for part in row.split()] for row in text.split(";")]
    return {"path": axis.path, "values": [row[0] if len(row) == 1 else row for row in rows]}


def load_figure(case: Case, reference: Case, name: str, finding: str) -> dict[str, Figure]:
    """Return the figure that compares the load along the face in two cases.

    The lines of `case` are solid, and the lines of `reference` are dashed. `name` is the name of `case` in the legend.
    The caption of the figure begins with the text `finding`. The result is empty if the load of one of the two cases
    cannot be drawn.
    """
    try:
        own, given = (LOAD_ALONE.figure(drawn_case.request, drawn_case.response) for drawn_case in (case, reference))
    except NoFigure:
        return {}
    (panel,) = compared(own, given, "as described").panels
    line, *dashed = panel.lines
    others = (replace(dashed_line, title="as described") for dashed_line in dashed)
    panel = replace(panel, lines=(replace(line, title=name), *others))
    return {LOAD_ALONE.name: replace(own, finding=f"{finding}{own.finding}, dashed {given.finding}", panels=(panel,))}


class CornersPage(UnitPage):
    """The page that shows the worst corner of a gear unit."""

    link = StudyLink(
        "corners",
        "Worst corner",
        "every combination of the uncertain inputs: where the result is worst",
        place=4,
        endpoint=DRIVE_TRAIN,
    )
    question = "which corner is worst?"
    about = f"The result is calculated for every combination of the uncertain inputs: {USUAL_RANGES}."
    figures = ("corners", LOAD_ALONE.name)
    corners = "ranges"
    plan = Corners
    study: Corners

    def body(self) -> dict[str, Any]:
        """Return the body of the request for the study.

        The body contains the values that the user typed for the uncertain inputs, or the usual values if the user typed
        none. The requested outputs are the output that the page shows, and all headline numbers that need neither the
        thermal film nor the cold state.
        """
        output, paths = self.output.path, [leaf.path for leaf in headlines(self.calculation.response)]
        deciding = [path for path in paths if not (needs_film(DRIVE_TRAIN, path) or path.startswith(COLD))]
        return {
            "request": self.asked.body,
            **self.given(),
            "outputs": list(dict.fromkeys([output, *deciding])),
        }

    def result(self, lines: list[Line]) -> Result:
        """Return two figures and two tables.

        One figure shows the effect of each uncertain input. The other figure compares the load along the face at the
        worst corner with the load of the case as entered. One table lists the extremes of each output, and the other
        table lists the inputs at the worst corner. If the output has no value at any corner, there are no figures and
        no tables.
        """
        end, output = lines[-1], self.output
        extremes = {line["output"]: line for line in lines if line["type"] == "extremes"}
        progress = f"{end['points']} corners in {shown(end['elapsed_s'], 2)} s"
        remarks = [warning["message"] for warning in end["warnings"]]
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
            Link("What to grind", self.asked.study(DESIGN)),
        )
        tables = (self._extremes(extremes, case), self.corner_table("The worst corner", case, worst))
        return Result(progress, {"corners": figure, **load}, tables, tuple(remarks), leads)

    def _rows(self, lines: list[Line], worst: Overrides) -> list[Row]:
        """Return one row of a dot plot per uncertain input, with one dot per value of the input.

        The position of a dot is the worst output among all corners at which the input has this value. If none of these
        corners has a solution, the dot is left out.
        """
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

    def _extremes(self, extremes: dict[str, Line], case: Case) -> Table:
        """Return a table of the least and the largest value of each output.

        Each least or largest value is a link to the corner at which the value occurs.
        """
        rows = []
        for leaf in self.study.outputs:
            if leaf.path in extremes:
                ends = [extremes[leaf.path][end] for end in ("min", "max")]
                least, largest = (Link(shown(end["value"]), self.address(end["at"])) for end in ends)
                rows.append((leaf.title, shown(value_at(case.response, leaf.path)), least, largest, leaf.unit or ""))
        head = ("output", Number("as described"), Number("least"), Number("largest"), "unit")
        return Table("Over all corners", head, rows, "Click a number to open the case at its corner.")


PAGE = CornersPage
