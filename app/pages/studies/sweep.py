"""A sweep: one field of a case varied, or two, drawn as a curve, as curves or as a map while its points come."""

import json
from collections import Counter
from dataclasses import dataclass
from math import ceil, floor, nan
from typing import Any, NamedTuple

import numpy as np

from app.calculations import Calculation
from app.errors import Unprocessable
from app.figures.data import Figure, values
from app.figures.studies import Coordinate, Grid, figures_of
from app.figures.units import axis_of
from app.pages.form import FieldView
from app.pages.query import number_of
from app.pages.studies.declaration import (
    Choice,
    Controls,
    Form,
    Link,
    Number,
    PageStudy,
    Result,
    StudyPage,
    Table,
    address_at,
    ended,
    numbered,
)
from app.pages.study_links import VARY, Starter, studies_of, studies_of_case
from app.pages.typesetting import shown, words
from app.pages.views import Asked
from app.schema.fields import Leaf, leaf_at, leaves, tree
from app.studies.engine import Line
from app.studies.fields import NUMBERS, scalar_at, value_at
from app.studies.point_sets import PointSet
from app.studies.points import SOLVED
from app.studies.requests import Scalar
from app.studies.sensitivity import places
from app.studies.sweep import Sweep, sweep_study

AROUND = 0.5  # of a value, to both sides
TOLERANCES = 4.0  # to both sides of zero
INSIDE = 1e-3  # of a range, away from an end that is not allowed
COUNTS = {"x": 21, "y": 5}  # points offered at first: a curve that looks smooth, few curves
AXES = ("x", "y")
TITLES = {"x": "Vary", "y": "and, as curves or a map"}
MOST_WHOLE = 10_000  # whole numbers that an axis is spread over
MOST_ROWS = 200  # of a table on a page; the file has all
MOST_REASONS = 6  # why points are missing, the most frequent


class Range(NamedTuple):
    """From and to."""

    start: float
    stop: float


@dataclass(frozen=True, slots=True)
class VariedField:
    """A field that is varied: its axis in the study, the range where none is typed, the value of the case itself."""

    leaf: Leaf
    axis: dict[str, Any]
    usual: Range | None
    own: float | None


def field_choices(calculation: Calculation, case: dict[str, Any], *, texts: bool) -> list[Choice]:
    """Every single field that has numbers, with its value in this case; and those with texts to choose from."""
    titles = {branch.path: branch.title for branch in tree(calculation.request).branches}
    found = []
    for leaf in leaves(calculation.request):
        if leaf.is_scalar and leaf.path != "detail" and (_has_numbers(leaf) or (texts and _texts_of(leaf))):
            group = titles.get(leaf.path.partition(".")[0], "general")
            found += [Choice(path, _label(leaf, path, case), group) for path in places(leaf.path, case)]
    return found


def _texts_of(leaf: Leaf) -> list[Scalar]:
    """What a field can be if it is no number."""
    return [True, False] if leaf.kind == "boolean" else [option for option in leaf.options if isinstance(option, str)]


def _grades_of(leaf: Leaf) -> list[float]:
    """The numbers of a field that takes only some."""
    return [option for option in leaf.options if isinstance(option, int | float) and not isinstance(option, bool)]


def _has_numbers(leaf: Leaf) -> bool:
    """Whether an axis can run along it."""
    return leaf.kind in NUMBERS or bool(_grades_of(leaf))


def _label(leaf: Leaf, path: str, case: dict[str, Any]) -> str:
    name = numbered(leaf.title, path)
    value = value_at(case, path)
    return name if value is None else f"{name} ({shown(value)}{f' {leaf.unit}' if leaf.unit else ''})"


def _usual_range(leaf: Leaf, value: float | None) -> Range | None:
    """Around the value of the case, inside what is allowed; None where the case has none and the field no two ends."""
    low, high = _ends(leaf)
    if value is None or (value == 0.0 and leaf.declared.tolerance is None):
        return None if low is None or high is None else _rounded(leaf, Range(low, high))
    reach = AROUND * abs(value) if value else TOLERANCES * (leaf.declared.tolerance or 0.0)
    start, stop = value - reach, value + reach
    start = start if low is None else max(start, low)
    stop = stop if high is None else min(stop, high)
    return _rounded(leaf, Range(start, stop))


def _ends(leaf: Leaf) -> tuple[float | None, float | None]:
    """Least and greatest value that are allowed."""
    bounds = leaf.declared.bounds
    low, high = (bounds.get(closed, bounds.get(beyond)) for closed, beyond in (("ge", "gt"), ("le", "lt")))
    margin = INSIDE * (high - low) if low is not None and high is not None else INSIDE
    if low is not None and "gt" in bounds:
        low += margin
    if high is not None and "lt" in bounds:
        high -= margin
    return low, high


def _rounded(leaf: Leaf, found: Range) -> Range:
    """Whole numbers where the field takes no others, else four digits."""
    if leaf.kind == "integer":
        return Range(ceil(found.start), floor(found.stop))
    return Range(*(float(f"{end:.4g}") for end in found))


def varied_fields(asked: Asked) -> list[VariedField]:
    """The fields that a query varies; raises Unprocessable with a path into the sweep."""
    case, views = asked.case, asked.views
    if views.get("y") and not views.get("x"):
        raise Unprocessable("missing", "choose a field to vary before a second one", "vary.0.path")
    if views.get("y") and views["y"] == views.get("x"):
        raise Unprocessable("duplicate_path", "this field is varied already; choose another", "vary.1.path")
    return [_varied(asked, case, name, place) for place, name in enumerate(AXES) if views.get(name)]


def _varied(asked: Asked, case: dict[str, Any], name: str, place: int) -> VariedField:
    views, where = asked.views, f"vary.{place}"
    leaf = scalar_at(asked.calculation.request, views[name], f"{where}.path", "unknown_path")
    value = value_at(case, leaf.path)
    own = float(value) if isinstance(value, int | float) and not isinstance(value, bool) else None
    if not _has_numbers(leaf):
        if name == "x" or not _texts_of(leaf):
            message = f"{leaf.title} has no numbers; vary another field along it"
            raise Unprocessable("not_scalar", message, f"{where}.path")
        return VariedField(leaf, {"path": leaf.path, "values": _texts_of(leaf)}, None, None)
    grades = _grades_of(leaf)
    usual = Range(min(grades), max(grades)) if grades else _usual_range(leaf, own)
    axis = _spread(views, name, usual, where)
    if grades:
        axis = _among(grades, axis)
    elif leaf.kind == "integer":
        axis = _whole(axis)
    return VariedField(leaf, {"path": leaf.path, **axis}, usual, own)


def _among(grades: list[float], spread: dict[str, Any]) -> dict[str, Any]:
    """Of a field that takes only some numbers those between the ends, if the ends are numbers."""
    if not all(isinstance(spread[end], int | float) for end in ("start", "stop")):
        return spread
    low, high = sorted((spread["start"], spread["stop"]))
    return {"values": [grade for grade in grades if low <= grade <= high]}


def _spread(views: dict[str, str], name: str, usual: Range | None, where: str) -> dict[str, Any]:
    """Start, stop, count and scale as typed, else as usual; what is no number stays text, for the validator."""
    start, stop = (views.get(f"{name}.{end}") for end in ("from", "to"))
    if usual is None and (start is None or stop is None):
        raise Unprocessable("values_or_range", "the case has no value here to go from: give from and to", where)
    spread = {
        "start": usual.start if start is None and usual else number_of(start or ""),
        "stop": usual.stop if stop is None and usual else number_of(stop or ""),
        "count": number_of(views.get(f"{name}.count", str(COUNTS[name]))),
        "scale": views.get(f"{name}.scale", "linear"),
    }
    if spread["start"] == spread["stop"]:
        raise Unprocessable("values_or_range", "from and to are the same", where)
    return spread


def _whole(spread: dict[str, Any]) -> dict[str, Any]:
    """Whole numbers as evenly spread as they can be, each once; what is no such spread is left to the validator."""
    start, stop, count = (spread[part] for part in ("start", "stop", "count"))
    if not all(isinstance(each, int) for each in (start, stop, count)) or not 2 <= count <= MOST_WHOLE:
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
    return tuple(
        Controls(
            TITLES[name],
            form.menu(
                name,
                "field",
                "choose …" if name == "x" else "nothing else",
                field_choices(asked.calculation, case, texts=name == "y"),
            ),
            _range(form, name, fields.get(name)),
        )
        for name in AXES
    )


def _range(form: Form, name: str, field: VariedField | None) -> tuple[FieldView, ...]:
    unit = (field.leaf.unit or "") if field else ""
    start, stop = field.usual if field and field.usual else (None, None)
    return (
        form.field(f"{name}.from", "from", start, unit),
        form.field(f"{name}.to", "to", stop, unit),
        form.field(f"{name}.count", "points", COUNTS[name]),
        form.field(f"{name}.scale", "steps", options=(("", "even steps"), ("log", "even ratios"))),
    )


def _shows(form: Form) -> tuple[FieldView, ...]:
    ends = (("", "by the output"), ("least", "least"), ("greatest", "greatest"))
    return (form.field("best", "the best is", options=ends),)


def _result(study: PageStudy, lines: list[Line]) -> Result:
    """The figures; at the end also every point with a link to its case."""
    sweep, fields = study.study, varied_fields(study.asked)
    assert isinstance(sweep, Sweep)
    received = [line for line in lines if line["type"] == "point"]
    figures = figures_of(_grid(study, sweep.points, fields, received))
    if not ended(lines):
        return Result("", dict([*figures.items()][:1]))
    unsolved = _unsolved(received)
    progress = f"{len(received)} points in {shown(lines[-1].get('elapsed_s'), 2)} s"
    reasons = Counter(text for line in received for text in _remarks(line)).most_common(MOST_REASONS)
    return Result(
        progress + (f"; {unsolved} without solution" if unsolved else ""),
        figures,
        (_table(study, sweep.points, fields, received),),
        tuple(f"{text} at {count} of {len(received)} points" for text, count in reasons),
        script=_script(study, sweep.points, fields, received, next(iter(figures.values()))),
    )


def _unsolved(received: list[Line]) -> int:
    return sum(line["status"] not in SOLVED for line in received)


def _remarks(point: Line) -> tuple[str, ...]:
    """Why a point has no solution, or its warnings."""
    error = point.get("error")
    return (error["message"],) if error else tuple(map(words, point["warnings"]))


def _invalid(point: Line) -> str | None:
    """The warnings that leave a value without meaning."""
    found = [words(code) for code, rank in zip(point["warnings"], point["ranks"], strict=True) if rank == "invalid"]
    return ", ".join(found) or None


def _grid(study: PageStudy, points: PointSet, fields: list[VariedField], received: list[Line]) -> Grid:
    """The data of the figures; a point that has not come yet is a gap."""
    axes = [each.values or [] for each in points.axes]
    found = np.full(points.total, nan)
    found[: len(received)] = [nan if line["out"][0] is None else float(line["out"][0]) for line in received]
    along = [_coordinate(field, listed) for field, listed in zip(fields, axes, strict=True)]
    coordinates, orders = zip(*along, strict=True)
    invalid: tuple[str | None, ...] = ()
    doubtful: tuple[bool, ...] = ()
    if len(axes) == 1 and len(received) == points.total:
        sorted_points = [received[place] for place in orders[0]]
        invalid = tuple(_invalid(line) for line in sorted_points)
        doubtful = tuple("doubtful" in line["ranks"] for line in sorted_points)
    return Grid(
        x=coordinates[0],
        y=coordinates[1] if len(coordinates) > 1 else None,
        output=axis_of(study.output),
        values=values(found.reshape([len(each) for each in axes])[np.ix_(*orders)]),
        greatest=_is_greatest_best(study.asked, study.output),
        limit=_limit(study),
        invalid=invalid if len(set(invalid)) > 1 else (),
        doubtful=doubtful if len(set(doubtful)) > 1 else (),
        unsolved=_unsolved(received),
    )


def _coordinate(field: VariedField, listed: list[Scalar | list[Scalar]]) -> tuple[Coordinate, list[int]]:
    """The values of a field in rising order, and the places where they stand in the sweep."""
    leaf = field.leaf
    if not all(isinstance(each, int | float) and not isinstance(each, bool) for each in listed):
        texts = tuple(("yes" if each else "no") if isinstance(each, bool) else words(str(each)) for each in listed)
        return Coordinate(axis_of(leaf), values(list(range(len(listed)))), texts), list(range(len(listed)))
    numbers = np.array(listed, dtype=np.float64)
    order = np.argsort(numbers, kind="stable")
    rising = values(numbers[order])
    log = field.axis.get("scale") == "log"
    limits = (float(rising[0]), float(rising[-1])) if log else None
    axis = axis_of(leaf, log=log, magnitude=False, limits=limits)
    scatters = leaf.declared.tolerance is not None
    return Coordinate(axis, rising, own=field.own, scatters=scatters), order.tolist()


def _limit(study: PageStudy) -> float | None:
    """What bounds the output, where that is a number of its own or of the case."""
    output = study.output
    limit = output.view.limit if output.view.bound else None
    if isinstance(limit, str):
        limit = value_at(study.asked.case, limit)
    return float(limit) if isinstance(limit, int | float) else None


def _table(study: PageStudy, points: PointSet, fields: list[VariedField], received: list[Line]) -> Table:
    rows = []
    for line in received[:MOST_ROWS]:
        at = [shown(each, 6) for each in points.overrides(line["index"]).values()]
        remarks = ", ".join(_remarks(line))
        status = line["status"].replace("_", " ") + (f": {remarks}" if remarks else "")
        address = point_address(study, line["index"])
        opened = Link("open", address, f"open the case at {', '.join(at)}")
        rows.append((*at, shown(line["out"][0]), status, opened))
    columns = [*(field.leaf for field in fields), study.output]
    titles = [f"{leaf.title}, {leaf.unit}" if leaf.unit else leaf.title for leaf in columns]
    head = (*map(Number, titles), "status", "case")
    more = len(received) - MOST_ROWS
    return Table(
        "Points", head, tuple(rows), f"and {more} points more in the CSV file" if more > 0 else "", folded=True
    )


def point_address(study: PageStudy, index: int) -> str:
    """The page of the case at a point."""
    assert isinstance(study.study, Sweep)
    return address_at(study.asked, study.study.points.overrides(index))


def _script(study: PageStudy, points: PointSet, fields: list[VariedField], received: list[Line], figure: Figure) -> str:
    """What the script of the page needs to find the point under the pointer and to open its case."""
    known = [leaf_at(study.asked.calculation.request, field.leaf.path) for field in fields]
    if not all(leaf is not None and leaf.is_scalar for leaf in known):  # an item of a list is no field of the form
        return ""
    from app.figures.drawing.image import places as places_of  # noqa: PLC0415  only workers draw

    place = places_of(figure)[0]
    axes = [
        {"path": each.leaf.path, "name": each.leaf.title, "unit": each.leaf.unit or "", "at": axis.values}
        for each, axis in zip(fields, points.axes, strict=True)
    ]
    content = {
        "address": study.asked.root + point_address(study, 0),
        "axes": axes,
        "out": [line["out"][0] for line in received],
        "title": study.output.title,
        "unit": study.output.unit or "",
        "map": place.panel.map is not None,
        "box": place.box,
        "ranges": [place.x, place.y],
    }
    return json.dumps(content)


def _is_varied(asked: Asked) -> bool:
    return bool(asked.views.get("x") or asked.views.get("y"))


def _starters(_: StudyPage, asked: Asked) -> list[Starter]:
    """The ready studies of examples; with a case of one's own they are asked of it, around its own values."""
    if not asked.pairs:
        return [Starter(each.title, each.source, each.address) for each in studies_of(asked.calculation)]
    return studies_of_case(asked.calculation, asked.pairs, asked.case)


SWEEP = StudyPage(
    link=VARY,
    question="vary an input",
    about="One question asked many times; every point is a case of its own.",
    figures=("curve", "family", "map", "worst"),
    body=_body,
    plan=sweep_study,
    result=_result,
    controls=_controls,
    shows=_shows,
    grows=True,
    complete=_is_varied,
    choose="Choose a field to vary. One field makes a curve; two make curves or a map. Without a range it goes from "
    "half to one and a half times the value of the case.",
    starters=_starters,
    files=("csv", "ndjson"),
)
