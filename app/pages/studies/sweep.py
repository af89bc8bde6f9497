"""The page of a sweep: the user varies one or two fields of a case.

The page draws a curve, several curves or a map while the points arrive.
"""

import json
from collections import Counter
from collections.abc import Sequence
from functools import cached_property
from math import ceil, floor, isfinite, nan
from typing import Any

import numpy as np

from app.errors import Unprocessable
from app.figures.data import Figure, values
from app.figures.studies import Coordinate, Grid, answer, figures_of
from app.figures.units import axis_of
from app.pages.charts import for_phones
from app.pages.form import FieldView
from app.pages.results import verdict_lines
from app.pages.studies.controls import Control, Menu, choices_of, field_choices, has_numbers
from app.pages.studies.page import Controls, Link, Number, Result, StudyPage, Table, output_choices, titled
from app.pages.study_kinds import ALSO, AXES, OIL_TESTS, VARY
from app.pages.study_links import Starter, StudyExample, studies_of, studies_of_case
from app.pages.typesetting import shown, words
from app.schema.fields import Leaf, leaf_at, value_at
from app.studies.fields import is_plain_number, scalar_at, whole_range
from app.studies.kinds.sweep import Sweep
from app.studies.point_sets import CheckedAxis
from app.studies.points import SOLVED
from app.studies.runner import Line

AROUND = 0.5  # half the width of a field's usual range, as a share of the field's value in the case
TOLERANCES = 4.0  # half the width of a field's usual range if the value is zero, in tolerances of the field
COUNTS = {"x": 21, "y": 5}  # default numbers of points: 21 make a smooth curve, and 5 curves are easy to tell apart
MOST_WHOLE = 10_000  # largest number of whole numbers on an axis
OF_FURTHER = tuple(f"-{place}" for place in range(2, 2 + len(ALSO)))  # ends of the names of further outputs' figures
FIRST = "vary.0"  # location of the first axis, which is the abscissa of the curves
MOST_ROWS = 200  # largest number of rows of a table on a page; the file has all rows
MOST_REASONS = 6  # largest number of remarks about points on a page; the most frequent remarks are shown


AXIS = (
    Control("", "path", read=str),
    Control(".from", "start", label="from"),
    Control(".to", "stop", label="to"),
    Control(".count", "count", label="points"),
    Control(".scale", "scale", "linear", str, label="steps", options=(("", "even steps"), ("log", "even ratios"))),
)
"""The controls of an axis. The name and the path of the axis are put before the name and the path of a control."""
HELD = Control(
    OIL_TESTS,
    "oil_tests",
    None,
    str,
    label="if the oil varies",
    options=(("", "its test stages stay"), ("held", "its limits are held")),
)


class SweepPage(StudyPage):
    """The page that shows a sweep of a case over one or two fields."""

    link = VARY
    question = "vary an input"
    about = "The calculation is repeated for many values. Every point is a case that can be opened."
    figures = tuple(f"{name}{of}" for of in ("", *OF_FURTHER) for name in ("curve", "family", "map", "worst"))
    grows = True
    needs = AXES
    choose = (
        "Choose a field to vary. One field gives a curve; two fields give curves or a map. If no range is given, the "
        "field is varied from half its value in the case to one and a half times this value."
    )
    plan = Sweep
    study: Sweep

    def _own(self, leaf: Leaf) -> float | None:
        """Return the value of a field in the case, or None if the value is not a number."""
        value = value_at(self.case, leaf.path)
        return float(value) if is_plain_number(value) else None

    def _usual_ends(self, leaf: Leaf) -> tuple[float, float] | tuple[None, None]:
        """Return the ends between which a field is varied if the user types no ends.

        If the field accepts only certain numbers, the ends are the least and the largest of these numbers. Otherwise
        the ends lie on both sides of the value in the case, inside the permissible range of the field. If the case has
        no value, or if the value is 0 and the field has no tolerance, the ends are the ends of the permissible range.
        If this range is infinite, the result is (None, None).

        The ends of an integer field are integers; other computed ends are rounded to four significant digits.
        """
        if numbers := [option for option in leaf.options if is_plain_number(option)]:
            return min(numbers), max(numbers)
        value, tolerance = self._own(leaf), leaf.declared.tolerance
        low, high = whole_range(leaf)
        if value:
            low, high = max(low, value - AROUND * abs(value)), min(high, value + AROUND * abs(value))
        elif value is not None and tolerance is not None:
            low, high = max(low, value - TOLERANCES * tolerance), min(high, value + TOLERANCES * tolerance)
        if not isfinite(high - low):
            return None, None
        return (ceil(low), floor(high)) if leaf.kind == "integer" else (float(f"{low:.4g}"), float(f"{high:.4g}"))

    def declared(self) -> tuple[Control, ...]:
        """Return the controls of the axes.

        An error of a whole axis is shown at the control for the start of this axis. An error of the list of axes is
        shown at the control `x.count`.
        """
        controls = [Control("x.count", "vary", sets=False), HELD]
        controls += [Control(name, f"outputs.{place}", sets=False) for place, name in enumerate(self.further, start=1)]
        for place, name in enumerate(AXES):
            path = self.views.get(name, "")
            usual: dict[str, Any] = {"count": COUNTS[name]}
            if leaf := self.field_at(path):
                usual |= zip(("start", "stop"), self._usual_ends(leaf), strict=True)
            for part in AXIS:
                own = part._replace(name=f"{name}{part.name}", path=f"vary.{place}.{part.path}", sets=bool(path))
                controls.append(own._replace(default=usual.get(part.path, part.default)))
            controls.append(Control(f"{name}.from", f"vary.{place}", sets=False))
        return tuple(controls)

    def _axis(self, given: dict[str, Any], where: str) -> dict[str, Any]:
        """Return the axis of a field from its ends, its number of points and its scale.

        `given` holds what the user typed for the axis. If the field accepts only a fixed set of values, the axis has
        these values; numbers outside the ends are left out. If the field accepts any integer in a range, the integers
        are spread as evenly as possible, and no integer occurs twice.

        Raises Unprocessable if the field cannot be varied on this axis, if an end is missing, or if both ends are
        equal.
        """
        leaf = scalar_at(self.calculation.request, given["path"], f"{where}.path", "unknown_path")
        axis, choices = {"path": leaf.path}, choices_of(leaf)
        if not has_numbers(leaf):
            if where == FIRST or not choices:
                message = f"the values of {leaf.title} are not numbers; vary another field along this axis"
                raise Unprocessable("not_scalar", message, f"{where}.path")
            return {**axis, "values": choices}
        start, stop, count, scale = given.get("start"), given.get("stop"), given["count"], given["scale"]
        if start is None or stop is None:
            raise Unprocessable(
                "values_or_range",
                "the case has no value of this field, so no range can be derived from the case; give 'from' and 'to'",
                where,
            )
        if start == stop:
            raise Unprocessable("values_or_range", "'from' and 'to' must be different", where)
        if choices and is_plain_number(start) and is_plain_number(stop):
            return {**axis, "values": [choice for choice in choices if min(start, stop) <= choice <= max(start, stop)]}
        is_whole = leaf.kind == "integer" and all(isinstance(number, int) for number in (start, stop, count))
        if not is_whole or not 2 <= count <= MOST_WHOLE:
            return {**axis, "start": start, "stop": stop, "count": count, "scale": scale}
        spread = np.geomspace if scale == "log" and min(start, stop) > 0 else np.linspace
        return {**axis, "values": np.unique(spread(start, stop, count).round()).astype(int).tolist(), "scale": scale}

    @property
    def further(self) -> list[str]:
        """The names of the menus of further outputs in which an output is chosen."""
        return [name for name in ALSO if self.views.get(name)]

    @cached_property
    def shown_outputs(self) -> list[Leaf]:
        """The outputs that the page shows, at most four; the first of them decides which point is best."""
        paths = [(self.views[name], f"outputs.{place}") for place, name in enumerate(self.further, start=1)]
        return [self.output, *(self.output_at(path, place) for path, place in paths)]

    def also_shows(self) -> tuple[Menu, ...]:
        """Return the menus of the second, third and fourth output."""
        choices, ranks = output_choices(self.calculation), ("second", "third", "fourth")
        return tuple(self.menu(name, f"{rank} output", "none", choices) for rank, name in zip(ranks, ALSO, strict=True))

    @property
    def is_greatest_best(self) -> bool:
        """True if the greatest value of the output is the best value.

        If the query does not say which value is best, the output decides. Raises Unprocessable if the query has a word
        other than "least" and "greatest".
        """
        best = self.views.get("best", "greatest" if self.output.view.greatest_is_best else "least")
        if best not in {"least", "greatest"}:
            raise Unprocessable("literal_error", "the field 'best' must be either 'least' or 'greatest'", "best")
        return best == "greatest"

    def body(self) -> dict[str, Any]:
        """Return the body with the axes, the output that the page shows, and the criterion for the best point."""
        goal, given = "maximise" if self.is_greatest_best else "minimise", self.given()
        x, y = map(self.views.get, AXES)
        if y and not x:
            raise Unprocessable("missing", "choose the first field to vary before the second field", "vary.0.path")
        if y and y == x:
            raise Unprocessable("duplicate_path", "this field is varied already; choose another field", "vary.1.path")
        return {
            "endpoint": self.calculation.path,
            "request": self.asked.body,
            "vary": [self._axis(axis, f"vary.{place}") for place, axis in enumerate(given.get("vary", []))],
            "outputs": [leaf.path for leaf in self.shown_outputs],
            "best": {goal: self.output.path},
            **{name: part for name, part in given.items() if name == HELD.path},
        }

    def controls(self) -> tuple[Controls, ...]:
        """Return a group of controls for each axis: a menu of fields, and form fields for the range of the axis."""
        fields = dict(zip(AXES, self.study.points.varied, strict=False)) if self.study else {}
        groups = []
        for name, title, empty in (("x", "Vary", "choose …"), ("y", "and, as curves or a map", "nothing else")):
            leaf = fields.get(name)
            unit = (leaf.unit or "") if leaf else ""
            start, stop = self._usual_ends(leaf) if leaf else (None, None)
            shows = {"start": (start, unit), "stop": (stop, unit), "count": (COUNTS[name], "")}
            ends = []
            for part in AXIS[1:]:
                usual, own_unit = shows.get(part.path, (None, ""))
                ends.append(self.field_of(part._replace(name=f"{name}{part.name}", default=usual, unit=own_unit)))
            choices = field_choices(self.calculation, self.case, texts=name == "y")
            groups.append(Controls(title, self.menu(name, "field", empty, choices), tuple(ends)))
        return tuple(groups)

    def shows(self) -> tuple[FieldView, ...]:
        """Return the menu with which the user states the best value of the output."""
        ends = (("", "by the output"), ("least", "least"), ("greatest", "greatest"))
        held = (self.field_of(HELD),) if self.views.get(HELD.name) or (self.study and self.study.tests) else ()
        return (self.field("best", "the best is", options=ends), *held)

    def starters(self) -> Sequence[Starter | StudyExample]:
        """Return links to ready studies."""
        if not self.asked.pairs:
            return studies_of(self.calculation, VARY.name)
        return studies_of_case(self.calculation, self.asked.pairs, self.case, pages=[VARY.name])

    def result(self, lines: list[Line]) -> Result:
        """Return the figures. After the end of the study, also return a table of the points."""
        received = [line for line in lines if line["type"] == "point"]
        grids = [self._grid(received, column) for column in range(len(self.shown_outputs))]
        figures = {
            f"{name}{of}": figure
            for of, grid in zip(("", *OF_FURTHER), grids, strict=False)
            for name, figure in figures_of(grid).items()
        }
        first, grid = next(iter(figures)), grids[0]
        if lines[-1]["type"] in {"sweep", "point"}:  # the study still runs
            return Result("", {name: figure for name, figure in figures.items() if not name.startswith("worst")})
        progress = f"{len(received)} points in {shown(lines[-1].get('elapsed_s'), 2)} s"
        reasons = Counter(text for line in received for text in _remarks(line)).most_common(MOST_REASONS)
        return Result(
            progress + (f"; {grid.unsolved} without solution" if grid.unsolved else ""),
            figures,
            (self._table(received),),
            (
                *(f"{remark}." for remark in self.study.remarks()),
                *(f"{text} at {count} of {len(received)} points" for text, count in reasons),
            ),
            self.oil_links(held=bool(self.study.held)) if self.study.tests else (),
            script=self._script(received, figures[first]),
            answer=" ".join([answer(grid), *(answer(each) for each in grids[1:] if each.is_constant)]),
        )

    def _grid(self, received: list[Line], column: int) -> Grid:
        """Return the data of the figures of an output, which stands in a column of the points.

        The values of the output are NaN at points without solution and at points that have not yet arrived.
        """
        output = self.shown_outputs[column]
        points = self.study.points
        outputs = np.full(points.total, nan)
        outputs[: len(received)] = [
            nan if line["out"][column] is None else float(line["out"][column]) for line in received
        ]
        coordinates, orders = zip(*map(self._coordinate, AXES, points.varied, points.axes), strict=True)
        is_whole_curve = len(coordinates) == 1 and len(received) == points.total
        sorted_points = [received[place] for place in orders[0]] if is_whole_curve else []
        invalid = tuple(_invalid(line) for line in sorted_points)
        doubtful = tuple("doubtful" in line["ranks"] for line in sorted_points)
        limit, good = verdict_lines(output.view, self.case)
        return Grid(
            x=coordinates[0],
            y=coordinates[1] if len(coordinates) > 1 else None,
            output=axis_of(output),
            values=values(outputs.reshape([len(order) for order in orders])[np.ix_(*orders)]),
            greatest=output.view.greatest_is_best if column else self.is_greatest_best,
            limit=limit,
            good=good,
            invalid=invalid if len(set(invalid)) > 1 else (),
            doubtful=doubtful if len(set(doubtful)) > 1 else (),
            unsolved=sum(line["status"] not in SOLVED for line in received),
        )

    def _coordinate(self, name: str, leaf: Leaf, axis_in_sweep: CheckedAxis) -> tuple[Coordinate, list[int]]:
        """Return the values of an axis of the sweep as a coordinate of the figure, and the order of these values."""
        in_sweep = axis_in_sweep.values or []
        if not all(map(is_plain_number, in_sweep)):
            order = list(range(len(in_sweep)))
            texts = tuple(
                ("yes" if value else "no") if isinstance(value, bool) else words(str(value)) for value in in_sweep
            )
            return Coordinate(axis_of(leaf), values(order), texts), order
        numbers = np.array(in_sweep, dtype=np.float64)
        order = np.argsort(numbers, kind="stable").tolist()
        rising = values(numbers[order])
        log = self.views.get(f"{name}.scale") == "log" and not leaf.options
        limits = (float(rising[0]), float(rising[-1])) if log else None
        axis = axis_of(leaf, log=log, magnitude=False, limits=limits)
        return Coordinate(axis, rising, own=self._own(leaf), scatters=leaf.declared.tolerance is not None), order

    def _table(self, received: list[Line]) -> Table:
        rows = []
        for line in received[:MOST_ROWS]:
            at = [shown(coordinate, 6) for coordinate in line["at"]]
            status, remarks = line["status"].replace("_", " "), ", ".join(_remarks(line))
            link = Link("open", self.point_address(line["index"]), f"open the case at {', '.join(at)}")
            rows.append((*at, *map(shown, line["out"]), f"{status}: {remarks}" if remarks else status, link))
        titles = [Number(titled(leaf)) for leaf in (*self.study.points.varied, *self.shown_outputs)]
        more = len(received) - MOST_ROWS
        note = f"and {more} more points in the CSV file" if more > 0 else ""
        return Table("Points", (*titles, "status", "case"), rows, note, folded=True)

    def point_address(self, index: int) -> str:
        """Return the address of the page that shows the case at a point."""
        return self.address({**self.study.held, **self.study.points.overrides(index)})

    def _script(self, received: list[Line], figure: Figure) -> str:
        """Return the data for the script of the page, as JSON. The script opens the case at the mouse pointer."""
        points = self.study.points
        if None in [leaf_at(self.calculation.request, leaf.path) for leaf in points.varied]:
            return ""
        from app.figures.drawing.image import places as places_of  # noqa: PLC0415  only workers draw

        place = places_of(figure)[0]
        content = {
            "address": self.asked.root + self.point_address(0),
            "axes": [
                {"path": leaf.path, "name": leaf.title, "unit": leaf.unit or "", "at": axis.values}
                for leaf, axis in zip(points.varied, points.axes, strict=True)
            ],
            "out": [line["out"][0] for line in received],
            "title": self.output.title,
            "unit": self.output.unit or "",
            "map": place.panel.map is not None,
            "box": place.box,
            "narrow": places_of(for_phones(figure))[0].box,
            "ranges": [place.x, place.y],
        }
        return json.dumps(content)


def _remarks(point: Line) -> list[str]:
    """Return the reason why a point has no solution, or the warnings of a point with a solution."""
    return [point["error"]["message"]] if "error" in point else [words(code) for code in point["warnings"]]


def _invalid(point: Line) -> str | None:
    """Return the warnings that make the values of a point invalid, as one text; None if there are no such warnings."""
    codes = [words(code) for code, rank in zip(point["warnings"], point["ranks"], strict=True) if rank == "invalid"]
    return ", ".join(codes) or None
