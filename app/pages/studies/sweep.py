"""A sweep: one field of a case varied, or two, drawn as a curve, as curves or as a map while its points come."""

import json
from collections import Counter
from collections.abc import Sequence
from math import ceil, floor, inf, isfinite, nan
from typing import Any

import numpy as np

from app.calculations import Calculation
from app.errors import Unprocessable
from app.figures.data import Figure, values
from app.figures.studies import Coordinate, Grid, answer, figures_of
from app.figures.units import axis_of
from app.pages import study_links
from app.pages.form import FieldView
from app.pages.studies.page import Choice, Controls, Link, Number, Result, StudyPage, Table, titled
from app.pages.study_links import Starter, StudyExample
from app.pages.typesetting import shown, words
from app.schema.fields import Leaf, leaf_at, leaves, tree
from app.studies.engine import Line
from app.studies.fields import NUMBERS, scalar_at, value_at
from app.studies.point_sets import CheckedAxis
from app.studies.points import SOLVED
from app.studies.sensitivity import places
from app.studies.sweep import Sweep

AROUND = 0.5  # of a value, to both sides
TOLERANCES = 4.0  # to both sides of zero
INSIDE = 1e-3  # of a range, away from an end that is not allowed
COUNTS = {"x": 21, "y": 5}  # points offered at first: a curve that looks smooth, few curves
AXES = ("x", "y")
MOST_WHOLE = 10_000  # whole numbers that an axis is spread over
MOST_ROWS = 200  # of a table on a page; the file has all
MOST_REASONS = 6  # why points are missing, the most frequent


def field_choices(calculation: Calculation, case: dict[str, Any], *, texts: bool) -> list[Choice]:
    """Every single field that has numbers, with its value in this case; and those with texts to choose from."""
    titles = {branch.path: branch.title for branch in tree(calculation.request).branches}
    found = []
    for leaf in leaves(calculation.request):
        if leaf.is_scalar and leaf.path != "detail" and (_has_numbers(leaf) or (texts and _choices_of(leaf))):
            group = titles.get(leaf.path.partition(".")[0], "general")
            unit = f" {leaf.unit}" if leaf.unit else ""
            for path in places(leaf.path, case):
                name, value = numbered(leaf.title, path), value_at(case, path)
                found.append(Choice(path, name if value is None else f"{name} ({shown(value)}{unit})", group))
    return found


def numbered(title: str, path: str) -> str:
    """Title of an input; which one it is where there are several."""
    places = [str(int(part) + 1) for part in path.split(".") if part.isdecimal()]
    return f"{title} {'.'.join(places)}" if places else title


def is_number(value: Any) -> bool:
    """Whether a value is a number and no truth value."""
    return isinstance(value, int | float) and not isinstance(value, bool)


def _choices_of(leaf: Leaf) -> list[Any]:
    """All values of a field that takes only some, either texts or numbers."""
    return [True, False] if leaf.kind == "boolean" else list(leaf.options)


def _has_numbers(leaf: Leaf) -> bool:
    """Whether an axis can run along it."""
    return leaf.kind in NUMBERS or any(map(is_number, leaf.options))


class SweepPage(StudyPage):
    """A sweep of a case over one or two fields."""

    link = study_links.VARY
    question = "vary an input"
    about = "One question asked many times; every point is a case of its own."
    figures = ("curve", "family", "map", "worst")
    grows = True
    needs = AXES
    choose = (
        "Choose a field to vary. One field makes a curve; two make curves or a map. Without a range it goes from "
        "half to one and a half times the value of the case."
    )
    files = ("csv", "ndjson")
    plan = Sweep
    study: Sweep

    def _own(self, leaf: Leaf) -> float | None:
        """The number in the case at the path of a field."""
        value = value_at(self.case, leaf.path)
        return float(value) if is_number(value) else None

    def _usual_ends(self, leaf: Leaf) -> tuple[float, float] | tuple[None, None]:
        """The ends between which a field is varied if none are typed; (None, None) where none can be chosen.

        They lie around the value of the case, inside the range of the field; without a value they are the range itself,
        if it has two finite ends. Integers, or numbers of four significant digits.
        """
        if numbers := [each for each in leaf.options if is_number(each)]:
            return min(numbers), max(numbers)
        value, bounds, tolerance = self._own(leaf), leaf.declared.bounds, leaf.declared.tolerance
        low, high = bounds.get("ge", bounds.get("gt", -inf)), bounds.get("le", bounds.get("lt", inf))
        margin = INSIDE * (high - low) if isfinite(high - low) else INSIDE
        if "gt" in bounds:
            low += margin
        if "lt" in bounds:
            high -= margin
        if value:
            low, high = max(low, value - AROUND * abs(value)), min(high, value + AROUND * abs(value))
        elif value is not None and tolerance is not None:
            low, high = max(low, value - TOLERANCES * tolerance), min(high, value + TOLERANCES * tolerance)
        if not isfinite(high - low):
            return None, None
        return (ceil(low), floor(high)) if leaf.kind == "integer" else (float(f"{low:.4g}"), float(f"{high:.4g}"))

    def _axis(self, name: str, where: str) -> dict[str, Any]:
        """The axis of a field, as typed or with its usual ends.

        A field that takes only certain values gets these, numbers only those between the ends; integers are spread as
        evenly as possible, each once. Other faults are left to the validator of the body. Raises Unprocessable at
        `where`.
        """
        leaf = scalar_at(self.calculation.request, self.views[name], f"{where}.path", "unknown_path")
        axis, choices = {"path": leaf.path}, _choices_of(leaf)
        if not _has_numbers(leaf):
            if name == "x" or not choices:
                message = f"{leaf.title} has no numbers; vary another field along it"
                raise Unprocessable("not_scalar", message, f"{where}.path")
            return {**axis, "values": choices}
        low, high = self._usual_ends(leaf)
        start, stop = self.number(f"{name}.from", low), self.number(f"{name}.to", high)
        if start is None or stop is None:
            raise Unprocessable("values_or_range", "the case has no value here to go from: give from and to", where)
        if start == stop:
            raise Unprocessable("values_or_range", "from and to are the same", where)
        if choices and is_number(start) and is_number(stop):
            return {**axis, "values": [each for each in choices if min(start, stop) <= each <= max(start, stop)]}
        count, scale = self.number(f"{name}.count", COUNTS[name]), self.views.get(f"{name}.scale", "linear")
        whole = leaf.kind == "integer" and all(isinstance(each, int) for each in (start, stop, count))
        if not whole or not 2 <= count <= MOST_WHOLE:
            return {**axis, "start": start, "stop": stop, "count": count, "scale": scale}
        spread = np.geomspace if scale == "log" and min(start, stop) > 0 else np.linspace
        return {**axis, "values": np.unique(spread(start, stop, count).round()).astype(int).tolist(), "scale": scale}

    @property
    def is_greatest_best(self) -> bool:
        """Whether the greatest value is sought; raises Unprocessable."""
        best = self.views.get("best", "greatest" if self.output.view.greatest_is_best else "least")
        if best not in {"least", "greatest"}:
            raise Unprocessable("literal_error", "best: must be one of least, greatest", "best")
        return best == "greatest"

    def body(self) -> dict[str, Any]:
        """The axes as typed or usual, the output, and whether its least or greatest value is sought."""
        goal = "maximise" if self.is_greatest_best else "minimise"
        x, y = map(self.views.get, AXES)
        if y and not x:
            raise Unprocessable("missing", "choose a field to vary before a second one", "vary.0.path")
        if y and y == x:
            raise Unprocessable("duplicate_path", "this field is varied already; choose another", "vary.1.path")
        return {
            "endpoint": self.calculation.path,
            "request": self.asked.body,
            "vary": [self._axis(name, f"vary.{place}") for place, name in enumerate(AXES) if self.views.get(name)],
            "outputs": [self.output.path],
            "best": {goal: self.output.path},
        }

    def places(self) -> dict[str, str]:
        """The controls of both axes; faults of the grid as a whole are shown at its number of points."""
        places = {"vary": "x.count"}
        parts = {"": ".from", ".path": "", ".stop": ".to", ".count": ".count", ".scale": ".scale"}
        for place, name in enumerate(AXES):
            places |= {f"vary.{place}{part}": f"{name}{control}" for part, control in parts.items()}
        return places

    def controls(self) -> tuple[Controls, ...]:
        """For each axis a menu of fields and the controls of its range, whose placeholders are the usual ends."""
        fields = dict(zip(AXES, self.study.points.varied, strict=False)) if self.study else {}
        groups = []
        for name, title, empty in (("x", "Vary", "choose …"), ("y", "and, as curves or a map", "nothing else")):
            leaf = fields.get(name)
            unit = (leaf.unit or "") if leaf else ""
            start, stop = self._usual_ends(leaf) if leaf else (None, None)
            ends = (
                self.field(f"{name}.from", "from", start, unit),
                self.field(f"{name}.to", "to", stop, unit),
                self.field(f"{name}.count", "points", COUNTS[name]),
                self.field(f"{name}.scale", "steps", options=(("", "even steps"), ("log", "even ratios"))),
            )
            choices = field_choices(self.calculation, self.case, texts=name == "y")
            groups.append(Controls(title, self.menu(name, "field", empty, choices), ends))
        return tuple(groups)

    def shows(self) -> tuple[FieldView, ...]:
        """The menu of whether the least or the greatest value of the output is sought."""
        ends = (("", "by the output"), ("least", "least"), ("greatest", "greatest"))
        return (self.field("best", "the best is", options=ends),)

    def starters(self) -> Sequence[Starter | StudyExample]:
        """Links to ready studies of examples; where the query has a case, of this case and around its values."""
        if not self.asked.pairs:
            return study_links.studies_of(self.calculation)
        return study_links.studies_of_case(self.calculation, self.asked.pairs, self.case)

    def result(self, lines: list[Line]) -> Result:
        """The figures, once the study has ended also a table of the points with links to their cases."""
        received = [line for line in lines if line["type"] == "point"]
        grid = self._grid(received)
        figures = figures_of(grid)
        first = next(iter(figures))
        if lines[-1]["type"] in {"sweep", "point"}:  # there are points to come
            return Result("", {first: figures[first]})
        progress = f"{len(received)} points in {shown(lines[-1].get('elapsed_s'), 2)} s"
        reasons = Counter(text for line in received for text in _remarks(line)).most_common(MOST_REASONS)
        return Result(
            progress + (f"; {grid.unsolved} without solution" if grid.unsolved else ""),
            figures,
            (self._table(received),),
            tuple(f"{text} at {count} of {len(received)} points" for text, count in reasons),
            script=self._script(received, figures[first]),
            answer=answer(grid),
        )

    def _grid(self, received: list[Line]) -> Grid:
        """The data of the figures; points without solution, and those that have not arrived, are NaN."""
        points = self.study.points
        found = np.full(points.total, nan)
        found[: len(received)] = [nan if line["out"][0] is None else float(line["out"][0]) for line in received]
        coordinates, orders = zip(*map(self._coordinate, AXES, points.varied, points.axes), strict=True)
        is_whole_curve = len(coordinates) == 1 and len(received) == points.total
        sorted_points = [received[place] for place in orders[0]] if is_whole_curve else []
        invalid = tuple(_invalid(line) for line in sorted_points)
        doubtful = tuple("doubtful" in line["ranks"] for line in sorted_points)
        limit = self.output.view.limit if self.output.view.bound else None
        if isinstance(limit, str):  # a field of the case
            limit = value_at(self.case, limit)
        return Grid(
            x=coordinates[0],
            y=coordinates[1] if len(coordinates) > 1 else None,
            output=axis_of(self.output),
            values=values(found.reshape([len(each) for each in orders])[np.ix_(*orders)]),
            greatest=self.is_greatest_best,
            limit=float(limit) if isinstance(limit, int | float) else None,
            invalid=invalid if len(set(invalid)) > 1 else (),
            doubtful=doubtful if len(set(doubtful)) > 1 else (),
            unsolved=sum(line["status"] not in SOLVED for line in received),
        )

    def _coordinate(self, name: str, leaf: Leaf, checked: CheckedAxis) -> tuple[Coordinate, list[int]]:
        """The values of a field in rising order, and the places where they stand in the sweep."""
        listed = checked.values or []
        if not all(map(is_number, listed)):
            order = list(range(len(listed)))
            texts = tuple(("yes" if each else "no") if isinstance(each, bool) else words(str(each)) for each in listed)
            return Coordinate(axis_of(leaf), values(order), texts), order
        numbers = np.array(listed, dtype=np.float64)
        order = np.argsort(numbers, kind="stable").tolist()
        rising = values(numbers[order])
        log = self.views.get(f"{name}.scale") == "log" and not leaf.options
        limits = (float(rising[0]), float(rising[-1])) if log else None
        axis = axis_of(leaf, log=log, magnitude=False, limits=limits)
        return Coordinate(axis, rising, own=self._own(leaf), scatters=leaf.declared.tolerance is not None), order

    def _table(self, received: list[Line]) -> Table:
        rows = []
        for line in received[:MOST_ROWS]:
            at = [shown(each, 6) for each in line["at"]]
            status, remarks = line["status"].replace("_", " "), ", ".join(_remarks(line))
            opened = Link("open", self.point_address(line["index"]), f"open the case at {', '.join(at)}")
            rows.append((*at, shown(line["out"][0]), f"{status}: {remarks}" if remarks else status, opened))
        titles = [Number(titled(leaf)) for leaf in (*self.study.points.varied, self.output)]
        more = len(received) - MOST_ROWS
        note = f"and {more} points more in the CSV file" if more > 0 else ""
        return Table("Points", (*titles, "status", "case"), rows, note, folded=True)

    def point_address(self, index: int) -> str:
        """The address of the page of the case at a point."""
        return self.address(self.study.points.overrides(index))

    def _script(self, received: list[Line], figure: Figure) -> str:
        """What the script of the page needs to find the point under the pointer and to open its case."""
        points = self.study.points
        if None in [leaf_at(self.calculation.request, leaf.path) for leaf in points.varied]:  # no field of the form
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
            "ranges": [place.x, place.y],
        }
        return json.dumps(content)


def _remarks(point: Line) -> list[str]:
    """Why a point has no solution, or its warnings."""
    return [point["error"]["message"]] if "error" in point else [words(code) for code in point["warnings"]]


def _invalid(point: Line) -> str | None:
    """The warnings that leave a value without meaning."""
    found = [words(code) for code, rank in zip(point["warnings"], point["ranks"], strict=True) if rank == "invalid"]
    return ", ".join(found) or None
