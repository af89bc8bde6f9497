"""A sweep: one field of a case varied, or two, drawn as a curve, as curves or as a map while its points come."""

import json
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, floor, inf, isfinite, nan
from typing import Any

import numpy as np

from app.calculations import Calculation
from app.errors import Unprocessable
from app.figures.data import Figure, values
from app.figures.studies import Coordinate, Grid, figures_of
from app.figures.units import axis_of
from app.pages.form import FieldView
from app.pages.query import number_of
from app.pages.studies.declaration import Choice, Controls, Form, Link, Number, PageStudy, Result, StudyPage, Table
from app.pages.study_links import VARY, Starter, StudyExample, studies_of, studies_of_case
from app.pages.typesetting import shown, words
from app.pages.views import Asked
from app.schema.fields import Leaf, leaf_at, leaves, tree
from app.studies.engine import Line
from app.studies.fields import NUMBERS, scalar_at, value_at
from app.studies.point_sets import PointSet
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


@dataclass(frozen=True, slots=True)
class VariedField:
    """A field that is varied: its axis in the study, the ends where none are typed, the value of the case itself."""

    leaf: Leaf
    axis: dict[str, Any]
    usual: tuple[float, float] | None
    own: float | None


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


def _choices_of(leaf: Leaf) -> list[Any]:
    """All values of a field that takes only some, either texts or numbers."""
    return [True, False] if leaf.kind == "boolean" else list(leaf.options)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _has_numbers(leaf: Leaf) -> bool:
    """Whether an axis can run along it."""
    return leaf.kind in NUMBERS or any(map(_is_number, leaf.options))


def _usual_ends(leaf: Leaf, value: float | None) -> tuple[float, float] | None:
    """Around the value of the case, inside what is allowed; None where the case has none and the range no two ends.

    Whole numbers where the field takes no others, else four digits.
    """
    bounds, tolerance = leaf.declared.bounds, leaf.declared.tolerance
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
        return None
    return (ceil(low), floor(high)) if leaf.kind == "integer" else (float(f"{low:.4g}"), float(f"{high:.4g}"))


def varied_fields(asked: Asked) -> list[VariedField]:
    """The fields that a query varies; raises Unprocessable with a path into the sweep."""
    views = asked.views
    if views.get("y") and not views.get("x"):
        raise Unprocessable("missing", "choose a field to vary before a second one", "vary.0.path")
    if views.get("y") and views["y"] == views.get("x"):
        raise Unprocessable("duplicate_path", "this field is varied already; choose another", "vary.1.path")
    case = asked.case
    return [_varied(asked, case, name, f"vary.{place}") for place, name in enumerate(AXES) if views.get(name)]


def _varied(asked: Asked, case: dict[str, Any], name: str, where: str) -> VariedField:
    leaf = scalar_at(asked.calculation.request, asked.views[name], f"{where}.path", "unknown_path")
    value, choices = value_at(case, leaf.path), _choices_of(leaf)
    own = float(value) if _is_number(value) else None
    if not _has_numbers(leaf):
        if name == "x" or not choices:
            message = f"{leaf.title} has no numbers; vary another field along it"
            raise Unprocessable("not_scalar", message, f"{where}.path")
        return VariedField(leaf, {"path": leaf.path, "values": choices}, None, None)
    usual = (min(choices), max(choices)) if choices else _usual_ends(leaf, own)
    axis = _axis(leaf, choices, _spread(asked.views, name, usual, where))
    return VariedField(leaf, {"path": leaf.path, **axis}, usual, own)


def _spread(views: dict[str, str], name: str, usual: tuple[float, float] | None, where: str) -> dict[str, Any]:
    """Start, stop, count and scale as typed, else as usual; what is no number stays text, for the validator."""
    typed = [views.get(f"{name}.{end}") for end in ("from", "to")]
    if usual is None and None in typed:
        raise Unprocessable("values_or_range", "the case has no value here to go from: give from and to", where)
    ends = zip(typed, usual or typed, strict=True)
    start, stop = (own if text is None else number_of(text) for text, own in ends)
    if start == stop:
        raise Unprocessable("values_or_range", "from and to are the same", where)
    count = number_of(views.get(f"{name}.count", str(COUNTS[name])))
    return {"start": start, "stop": stop, "count": count, "scale": views.get(f"{name}.scale", "linear")}


def _axis(leaf: Leaf, choices: list[float], spread: dict[str, Any]) -> dict[str, Any]:
    """The axis of a field: its spread, or where the field takes only some numbers, those between the ends.

    Whole numbers are as evenly spread as they can be, each once. What is no spread is left to the validator.
    """
    start, stop, count = (spread[part] for part in ("start", "stop", "count"))
    if choices and _is_number(start) and _is_number(stop):
        return {"values": [each for each in choices if min(start, stop) <= each <= max(start, stop)]}
    whole = leaf.kind == "integer" and all(isinstance(each, int) for each in (start, stop, count))
    if not whole or not 2 <= count <= MOST_WHOLE:
        return spread
    log = spread["scale"] == "log" and min(start, stop) > 0
    numbers = np.geomspace(start, stop, count) if log else np.linspace(start, stop, count)
    return {"values": np.unique(numbers.round()).astype(int).tolist(), "scale": spread["scale"]}


def _is_greatest_best(asked: Asked, output: Leaf) -> bool:
    best = asked.views.get("best", "greatest" if output.view.greatest_is_best else "least")
    if best not in {"least", "greatest"}:
        raise Unprocessable("literal_error", "best: must be one of least, greatest", "best")
    return best == "greatest"


def _body(asked: Asked, output: Leaf) -> dict[str, Any]:
    goal = "maximise" if _is_greatest_best(asked, output) else "minimise"
    return {
        "endpoint": asked.calculation.path,
        "request": asked.body,
        "vary": [each.axis for each in varied_fields(asked)],
        "outputs": [output.path],
        "best": {goal: output.path},
    }


def _controls(form: Form) -> tuple[Controls, ...]:
    """The axes: menus of fields, ranges with what stands for them when empty."""
    asked = form.asked
    case = {} if "" in form.faults else asked.case
    fields = dict(zip(AXES, varied_fields(asked), strict=False)) if form.accepted else {}
    groups = []
    for name, title, empty in (("x", "Vary", "choose …"), ("y", "and, as curves or a map", "nothing else")):
        field = fields.get(name)
        unit = (field.leaf.unit or "") if field else ""
        start, stop = field.usual if field and field.usual else (None, None)
        ends = (
            form.field(f"{name}.from", "from", start, unit),
            form.field(f"{name}.to", "to", stop, unit),
            form.field(f"{name}.count", "points", COUNTS[name]),
            form.field(f"{name}.scale", "steps", options=(("", "even steps"), ("log", "even ratios"))),
        )
        choices = field_choices(asked.calculation, case, texts=name == "y")
        groups.append(Controls(title, form.menu(name, "field", empty, choices), ends))
    return tuple(groups)


def _shows(form: Form) -> tuple[FieldView, ...]:
    ends = (("", "by the output"), ("least", "least"), ("greatest", "greatest"))
    return (form.field("best", "the best is", options=ends),)


def _result(study: PageStudy, lines: list[Line]) -> Result:
    """The figures; at the end also every point with a link to its case."""
    fields = varied_fields(study.asked)
    received = [line for line in lines if line["type"] == "point"]
    grid = _grid(study, fields, received)
    figures = figures_of(grid)
    first = next(iter(figures))
    if lines[-1]["type"] in {"sweep", "point"}:  # there are points to come
        return Result("", {first: figures[first]})
    progress = f"{len(received)} points in {shown(lines[-1].get('elapsed_s'), 2)} s"
    reasons = Counter(text for line in received for text in _remarks(line)).most_common(MOST_REASONS)
    return Result(
        progress + (f"; {grid.unsolved} without solution" if grid.unsolved else ""),
        figures,
        (_table(study, fields, received),),
        tuple(f"{text} at {count} of {len(received)} points" for text, count in reasons),
        script=_script(study, fields, received, figures[first]),
    )


def _remarks(point: Line) -> list[str]:
    """Why a point has no solution, or its warnings."""
    return [point["error"]["message"]] if "error" in point else [words(code) for code in point["warnings"]]


def _points(study: PageStudy) -> PointSet:
    assert isinstance(study.study, Sweep)
    return study.study.points


def _grid(study: PageStudy, fields: list[VariedField], received: list[Line]) -> Grid:
    """The data of the figures; a point that has not come yet is a gap."""
    axes, total = [each.values or [] for each in _points(study).axes], _points(study).total
    found = np.full(total, nan)
    found[: len(received)] = [nan if line["out"][0] is None else float(line["out"][0]) for line in received]
    along = [_coordinate(field, listed) for field, listed in zip(fields, axes, strict=True)]
    coordinates, orders = zip(*along, strict=True)
    is_whole_curve = len(axes) == 1 and len(received) == total
    sorted_points = [received[place] for place in orders[0]] if is_whole_curve else []
    invalid = tuple(_invalid(line) for line in sorted_points)
    doubtful = tuple("doubtful" in line["ranks"] for line in sorted_points)
    limit = study.output.view.limit if study.output.view.bound else None
    if isinstance(limit, str):  # a field of the case
        limit = value_at(study.asked.case, limit)
    return Grid(
        x=coordinates[0],
        y=coordinates[1] if len(axes) > 1 else None,
        output=axis_of(study.output),
        values=values(found.reshape([len(each) for each in axes])[np.ix_(*orders)]),
        greatest=_is_greatest_best(study.asked, study.output),
        limit=float(limit) if isinstance(limit, int | float) else None,
        invalid=invalid if len(set(invalid)) > 1 else (),
        doubtful=doubtful if len(set(doubtful)) > 1 else (),
        unsolved=sum(line["status"] not in SOLVED for line in received),
    )


def _invalid(point: Line) -> str | None:
    """The warnings that leave a value without meaning."""
    found = [words(code) for code, rank in zip(point["warnings"], point["ranks"], strict=True) if rank == "invalid"]
    return ", ".join(found) or None


def _coordinate(field: VariedField, listed: list[Any]) -> tuple[Coordinate, list[int]]:
    """The values of a field in rising order, and the places where they stand in the sweep."""
    leaf = field.leaf
    if not all(map(_is_number, listed)):
        order = list(range(len(listed)))
        texts = tuple(("yes" if each else "no") if isinstance(each, bool) else words(str(each)) for each in listed)
        return Coordinate(axis_of(leaf), values(order), texts), order
    numbers = np.array(listed, dtype=np.float64)
    order = np.argsort(numbers, kind="stable").tolist()
    rising = values(numbers[order])
    log = field.axis.get("scale") == "log"
    limits = (float(rising[0]), float(rising[-1])) if log else None
    axis = axis_of(leaf, log=log, magnitude=False, limits=limits)
    return Coordinate(axis, rising, own=field.own, scatters=leaf.declared.tolerance is not None), order


def _table(study: PageStudy, fields: list[VariedField], received: list[Line]) -> Table:
    rows = []
    for line in received[:MOST_ROWS]:
        at = [shown(each, 6) for each in _points(study).overrides(line["index"]).values()]
        status, remarks = line["status"].replace("_", " "), ", ".join(_remarks(line))
        opened = Link("open", point_address(study, line["index"]), f"open the case at {', '.join(at)}")
        rows.append((*at, shown(line["out"][0]), f"{status}: {remarks}" if remarks else status, opened))
    columns = [*(field.leaf for field in fields), study.output]
    titles = [Number(f"{leaf.title}, {leaf.unit}" if leaf.unit else leaf.title) for leaf in columns]
    more = len(received) - MOST_ROWS
    note = f"and {more} points more in the CSV file" if more > 0 else ""
    return Table("Points", (*titles, "status", "case"), tuple(rows), note, folded=True)


def point_address(study: PageStudy, index: int) -> str:
    """The page of the case at a point."""
    return study.address(_points(study).overrides(index))


def _script(study: PageStudy, fields: list[VariedField], received: list[Line], figure: Figure) -> str:
    """What the script of the page needs to find the point under the pointer and to open its case."""
    known = [leaf_at(study.asked.calculation.request, field.leaf.path) for field in fields]
    if not all(leaf is not None and leaf.is_scalar for leaf in known):  # an item of a list is no field of the form
        return ""
    from app.figures.drawing.image import places as places_of  # noqa: PLC0415  only workers draw

    place = places_of(figure)[0]
    content = {
        "address": study.asked.root + point_address(study, 0),
        "axes": [
            {"path": each.leaf.path, "name": each.leaf.title, "unit": each.leaf.unit or "", "at": axis.values}
            for each, axis in zip(fields, _points(study).axes, strict=True)
        ],
        "out": [line["out"][0] for line in received],
        "title": study.output.title,
        "unit": study.output.unit or "",
        "map": place.panel.map is not None,
        "box": place.box,
        "ranges": [place.x, place.y],
    }
    return json.dumps(content)


def _starters(_: str, asked: Asked) -> Sequence[Starter | StudyExample]:
    """The ready studies of examples; with a case of one's own they are asked of it, around its own values."""
    if not asked.pairs:
        return studies_of(asked.calculation)
    return studies_of_case(asked.calculation, asked.pairs, asked.case)


SWEEP = StudyPage(
    link=VARY,
    question="vary an input",
    about="One question asked many times; every point is a case of its own.",
    figures=("curve", "family", "map", "worst"),
    body=_body,
    plan=Sweep,
    result=_result,
    controls=_controls,
    shows=_shows,
    grows=True,
    needs=AXES,
    choose="Choose a field to vary. One field makes a curve; two make curves or a map. Without a range it goes from "
    "half to one and a half times the value of the case.",
    starters=_starters,
    files=("csv", "ndjson"),
)
