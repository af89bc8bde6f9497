"""What the query of a study asks: which fields, from where to where, which output, and which end of it is the best."""

import json
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.calculations import Calculation
from app.pages.query import LOWER, TRIALS, UPPER, Pairs, body_of, number_of
from app.pages.vary.choices import Range, grades_of, has_numbers, usual_range, words_of
from app.problems import Unprocessable
from app.reading import InvalidBody, validated
from app.schema.fields import Leaf, headlines, leaf_at
from app.studies.fields import scalar_at, value_at
from app.studies.sensitivity import NUMBERS

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
class Wish:
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


def wish_of(calculation: Calculation, case: dict[str, Any], said: dict[str, str]) -> Wish:
    """What is asked for; raises Unprocessable with a path into the sweep."""
    fields = [_varied(calculation, case, said, name, place) for place, name in enumerate(AXES) if said.get(name)]
    output = shown_output(calculation, said)
    best = said.get("best", "greatest" if output.bound == "lower" else "least")
    if best not in {"least", "greatest"}:
        raise Unprocessable("literal_error", "best: allowed are least, greatest", "best")
    return Wish(tuple(fields), output, best == "greatest")


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


def sweep_of(calculation: Calculation, pairs: Pairs, wish: Wish) -> bytes:
    """The body for the sweep's endpoint, which says the same."""
    goal = "maximise" if wish.greatest else "minimise"
    content = {
        "endpoint": calculation.path,
        "request": body_of(calculation.request, pairs),
        "vary": [each.axis for each in wish.fields],
        "outputs": [wish.output.path],
        "best": {goal: wish.output.path},
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
