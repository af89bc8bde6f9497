"""The sweep that the query of a page asks for: its fields, their ranges, the output shown.

A range that is not given is around the value of the case.
"""

import json
from dataclasses import dataclass
from math import ceil, floor
from typing import Any, NamedTuple

import numpy as np

from app.calculations import Calculation
from app.errors import InvalidBody, Unprocessable
from app.pages.query import LOWER, TRIALS, UPPER, Pairs, body_of, number_of
from app.pages.results import NOT_RESULTS
from app.pages.typesetting import shown
from app.schema.fields import ITEM, Leaf, headlines, leaf_at, leaves, tree
from app.schema.reading import validated
from app.studies.fields import scalar_at, value_at
from app.studies.requests import Scalar
from app.studies.sensitivity import NUMBERS, places

AROUND = 0.5  # of a value, to both sides
TOLERANCES = 4.0  # to both sides of zero
INSIDE = 1e-3  # of a range, away from an end that is not allowed


class Range(NamedTuple):
    """From and to."""

    start: float
    stop: float


@dataclass(frozen=True, slots=True)
class Choice:
    """An entry of a menu, in a group."""

    path: str
    label: str
    group: str


def varied(calculation: Calculation, case: dict[str, Any], *, words: bool) -> list[Choice]:
    """Every single field that has numbers, with its value in this case; and those with words to choose from."""
    titles = {branch.path: branch.title for branch in tree(calculation.request).branches}
    found = []
    for leaf in leaves(calculation.request):
        if leaf.is_scalar and leaf.path != "detail" and (has_numbers(leaf) or (words and words_of(leaf))):
            group = titles.get(leaf.path.partition(".")[0], "general")
            found += [Choice(path, _label(leaf, path, case), group) for path in places(leaf.path, case)]
    return found


def words_of(leaf: Leaf) -> list[Scalar]:
    """What a field can be if it is no number."""
    return [True, False] if leaf.kind == "boolean" else [option for option in leaf.options if isinstance(option, str)]


def grades_of(leaf: Leaf) -> list[float]:
    """The numbers of a field that takes only some."""
    return [option for option in leaf.options if isinstance(option, int | float) and not isinstance(option, bool)]


def has_numbers(leaf: Leaf) -> bool:
    """Whether an axis can run along it."""
    return leaf.kind in NUMBERS or bool(grades_of(leaf))


def _label(leaf: Leaf, path: str, case: dict[str, Any]) -> str:
    number = next((part for part in path.split(".") if part.isdecimal()), None)
    name = leaf.title if number is None else f"{leaf.title} {int(number) + 1}"
    value = value_at(case, path)
    return name if value is None else f"{name} ({shown(value)}{f' {leaf.unit}' if leaf.unit else ''})"


def shown_outputs(calculation: Calculation) -> list[Choice]:
    """Every number of the answer that a study can tell, the headlines first."""
    response = calculation.response
    first = headlines(response)
    rest = [leaf for leaf in leaves(response) if _is_told(leaf) and leaf not in first]
    titles = {branch.path: branch.title for branch in tree(response).branches}
    return [Choice(leaf.path, _named(leaf), "numbers that decide") for leaf in first if _is_told(leaf)] + [
        Choice(leaf.path, _named(leaf), titles.get(leaf.path.partition(".")[0], "result")) for leaf in rest
    ]


def _is_told(leaf: Leaf) -> bool:
    whole = leaf.is_scalar and leaf.kind in NUMBERS and leaf.detail == "summary" and ITEM not in leaf.path.split(".")
    return whole and leaf.path.partition(".")[0] not in NOT_RESULTS


def _named(leaf: Leaf) -> str:
    return f"{leaf.title}, {leaf.unit}" if leaf.unit else leaf.title


def usual_range(leaf: Leaf, value: float | None) -> Range | None:
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


COUNTS = {"x": 21, "y": 5}
MOST_WHOLE = 10_000
AXES = ("x", "y")


@dataclass(frozen=True, slots=True)
class Varied:
    """A field that is varied, and what was said of it."""

    leaf: Leaf
    axis: dict[str, Any]
    usual: Range | None
    own: float | None

    @property
    def path(self) -> str:
        """Where the field is."""
        return self.leaf.path


@dataclass(frozen=True, slots=True)
class SweepQuery:
    """One field or two, the output shown, and whether its greatest value is the best."""

    fields: tuple[Varied, ...]
    output: Leaf
    greatest: bool


def case_of(calculation: Calculation, pairs: Pairs) -> dict[str, Any]:
    """The case with its defaults, as far as it is one: a field that is to be varied may be missing."""
    body = body_of(calculation.request, pairs)
    try:
        return validated(calculation.request, body).model_dump()
    except InvalidBody:
        return body


def query_of(calculation: Calculation, case: dict[str, Any], said: dict[str, str]) -> SweepQuery:
    """The sweep of a query; raises Unprocessable with a path into the sweep."""
    fields = [_varied(calculation, case, said, name, place) for place, name in enumerate(AXES) if said.get(name)]
    output = shown_output(calculation, said)
    best = said.get("best", "greatest" if output.view.bound == "lower" else "least")
    if best not in {"least", "greatest"}:
        raise Unprocessable("literal_error", "best: allowed are least, greatest", "best")
    return SweepQuery(tuple(fields), output, best == "greatest")


def shown_output(calculation: Calculation, said: dict[str, str]) -> Leaf:
    """The output asked for, else the first headline; raises Unprocessable."""
    first = headlines(calculation.response)[0].path
    output = scalar_at(calculation.response, said.get("show", first), "outputs.0", "unknown_output")
    if output.kind not in NUMBERS:
        raise Unprocessable("unknown_output", f"{output.path} is no number", "outputs.0")
    return output


def _varied(calculation: Calculation, case: dict[str, Any], said: dict[str, str], name: str, place: int) -> Varied:
    where = f"vary.{place}"
    leaf = scalar_at(calculation.request, said[name], f"{where}.path", "unknown_path")
    value = value_at(case, leaf.path)
    own = float(value) if isinstance(value, int | float) and not isinstance(value, bool) else None
    if not has_numbers(leaf):
        if name == "x" or not words_of(leaf):
            message = f"{leaf.title} has no numbers; vary another field along it"
            raise Unprocessable("not_scalar", message, f"{where}.path")
        return Varied(leaf, {"path": leaf.path, "values": words_of(leaf)}, None, None)
    grades = grades_of(leaf)
    usual = Range(min(grades), max(grades)) if grades else usual_range(leaf, own)
    axis = _spread(said, name, usual, where)
    if grades:
        axis = _among(grades, axis)
    elif leaf.kind == "integer":
        axis = _whole(axis)
    return Varied(leaf, {"path": leaf.path, **axis}, usual, own)


def _among(grades: list[float], spread: dict[str, Any]) -> dict[str, Any]:
    """Of a field that takes only some numbers those between the ends, if the ends are numbers."""
    if not all(isinstance(spread[end], int | float) for end in ("start", "stop")):
        return spread
    low, high = sorted((spread["start"], spread["stop"]))
    return {"values": [grade for grade in grades if low <= grade <= high]}


def _spread(said: dict[str, str], name: str, usual: Range | None, where: str) -> dict[str, Any]:
    """Start, stop, count and scale as typed, else as usual; what is no number stays text, for the validator."""
    start, stop = (said.get(f"{name}.{end}") for end in ("from", "to"))
    if usual is None and (start is None or stop is None):
        raise Unprocessable("values_or_range", "the case has no value here to go from: give from and to", where)
    spread = {
        "start": usual.start if start is None and usual else number_of(start or ""),
        "stop": usual.stop if stop is None and usual else number_of(stop or ""),
        "count": number_of(said.get(f"{name}.count", str(COUNTS[name]))),
        "scale": said.get(f"{name}.scale", "linear"),
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
    places = np.geomspace(start, stop, count) if log else np.linspace(start, stop, count)
    return {"values": np.unique(places.round()).astype(int).tolist(), "scale": spread["scale"]}


def sweep_of(calculation: Calculation, pairs: Pairs, query: SweepQuery) -> bytes:
    """The body for the sweep's endpoint, which says the same."""
    goal = "maximise" if query.greatest else "minimise"
    content = {
        "endpoint": calculation.path,
        "request": body_of(calculation.request, pairs),
        "vary": [each.axis for each in query.fields],
        "outputs": [query.output.path],
        "best": {goal: query.output.path},
    }
    return json.dumps(content).encode()


def field_at_fault(path: str) -> str:
    """The control of the form that a path into the study means; a field of the case keeps its own name."""
    head, _, rest = path.partition(".")
    match head:
        case "vary":
            place, _, part = rest.partition(".")
            name = AXES[int(place)] if place in {"0", "1"} else "x"
            known = {"path": "", "stop": ".to", "count": ".count", "scale": ".scale"}
            return name + (known.get(part, ".from") if place else ".count")
        case "variables":
            place, _, part = rest.partition(".")
            return f"{UPPER if part == 'max' else LOWER}{place}"
        case "evaluations":
            return TRIALS
        case "outputs" | "objective":
            return "show"
        case "request":
            return rest
        case _:
            return path


def is_leaf(calculation: Calculation, path: str) -> bool:
    """Whether the path is a field of its own, not an item of a list of numbers."""
    leaf = leaf_at(calculation.request, path)
    return leaf is not None and leaf.is_scalar
