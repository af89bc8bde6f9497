"""What the pages of studies of a gear unit share: controls of the uncertain inputs, and the load of two cases."""

from dataclasses import replace
from functools import cached_property, partial
from typing import Any

from app.figures.comparison import compared
from app.figures.data import Figure, NoFigure
from app.models.drive_train.figures import LOAD_ALONE
from app.pages.cases import REFUSED, SolvedCase
from app.pages.studies.controls import Control, numbered
from app.pages.studies.page import Controls, Number, StudyPage, Table, titled
from app.pages.study_kinds import control_of
from app.pages.typed import number_of, text_of
from app.pages.typesetting import shown
from app.schema.fields import value_at
from app.studies.point_sets import usual_corners
from app.studies.points import BaseRequest
from app.studies.requests import Axis, Overrides


class UnitPage(StudyPage):
    """Base class of the pages of studies that vary the uncertain inputs of a gear unit.

    `corners` is the field of the request that contains the values of the uncertain inputs.
    """

    outputs = ("safety.blok_flank",)
    corners = "corners"

    @property
    def left_alone(self) -> tuple[str, ...]:
        """The uncertain inputs that are varied only if the user types values for them."""
        return ()

    @cached_property
    def uncertain(self) -> dict[str, Axis]:
        """Study axes with the usual values of the uncertain inputs; the keys are the names of the inputs."""
        try:
            return usual_corners(BaseRequest(self.calculation, self.asked.body).checked({}))
        except REFUSED:
            return {}

    def declared(self) -> tuple[Control, ...]:
        """Return one form control per uncertain input, in which the user types the values of this input."""
        controls: list[Control] = []
        for quantity, axis in self.uncertain.items():
            name = control_of(quantity)
            usual = None if quantity in self.left_alone else {"path": axis.path, "values": axis.values}
            if usual or self.views.get(name):
                controls.append(Control(name, f"{self.corners}.{len(controls)}", usual, partial(typed_axis, axis)))
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

    def corner_table(self, title: str, case: SolvedCase, corner: Overrides) -> Table:
        """Return a table of the inputs that a corner changes."""
        rows = []
        for path, value in corner.items():
            leaf = self.input(path)
            described = shown(value_at(case.response.inputs, path))
            rows.append((numbered(leaf.title, path), described, shown(value), leaf.unit or ""))
        return Table(title, ("input", Number("as described"), Number("there"), "unit"), rows)


def typed_axis(axis: Axis, text: str) -> dict[str, Any]:
    """Return the path of an uncertain input, and the values that the user typed for this input."""
    rows = [[number_of(part) for part in row.split()] for row in text.split(";")]
    return {"path": axis.path, "values": [row[0] if len(row) == 1 else row for row in rows]}


def load_figure(case: SolvedCase, reference: SolvedCase, name: str, finding: str) -> dict[str, Figure]:
    """Return the figure that compares the load along the face in two cases."""
    try:
        own, given = (LOAD_ALONE.figure(drawn_case.request, drawn_case.response) for drawn_case in (case, reference))
    except NoFigure:
        return {}
    (panel,) = compared(own, given, "as described").panels
    line, *dashed = panel.lines
    others = (replace(dashed_line, title="as described") for dashed_line in dashed)
    panel = replace(panel, lines=(replace(line, title=name), *others))
    return {LOAD_ALONE.name: replace(own, finding=f"{finding}{own.finding}, dashed {given.finding}", panels=(panel,))}
