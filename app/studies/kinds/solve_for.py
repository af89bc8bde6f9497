"""Solve for an input: where an output has a given value, or where it is least or greatest, along one input."""

from collections import Counter
from collections.abc import Sequence
from contextlib import aclosing
from dataclasses import dataclass, field
from itertools import groupby
from math import ceil, exp, floor, inf, isfinite, log
from typing import Annotated, Any, Literal, NamedTuple

import numpy as np

from app.errors import Unprocessable
from app.schema.fields import Leaf, value_at
from app.schema.model import Request
from app.schema.quantities import Input
from app.studies import runner
from app.studies.fields import NUMBERS, check_value, is_number, is_plain_number, not_a_number, whole_range
from app.studies.oil_tests import NAME, candidates, hold, remarks_on, tests_moved
from app.studies.point_sets import common_unit
from app.studies.points import SOLVED, BaseRequest, Point, check_count
from app.studies.requests import (
    LARGEST,
    OIL_TESTS,
    FieldPath,
    FieldPaths,
    FieldsTogether,
    OilTests,
    Overrides,
    Part,
    Scalar,
)
from app.studies.runner import Clock, Line, Lines, Pool, Study, Tally, output_header
from app.studies.search import OUTLINE, Extreme, Search, Step, found, next_step

FACTOR = 4.0  # default range of a field above zero: the value of the case divided and multiplied by this; chosen
TOLERANCES = 10.0  # least half width of the default range of any other field, in its tolerances; chosen
WIDE = 100.0  # a whole range whose ends have a greater ratio is scanned in even ratios
MOST_STEPS, USUAL_STEPS = 100, 8  # points after the scan: most of them, and those of a single answer
SAME = 1e-9  # places of a range that are nearer than this share of it are one
LIST_SCANNED = 2  # a list of at most this many times the points of the scan is scanned as a whole


class Sought(FieldsTogether):
    """The field that is sought, or several fields with one value, and the range in which it is sought."""

    path: Annotated[FieldPaths, Input("field to find", text="dotted path, or several fields of one value")]
    min: Annotated[
        float | None,
        Input("lower end", default_text="near the value of the case, inside the range of the field"),
    ] = None
    max: Annotated[float | None, Input("upper end", default_text="as for the lower end")] = None
    scale: Annotated[
        Literal["linear", "log"] | None,
        Input("scale", text="even steps or even ratios in the scan", default_text="by the range"),
    ] = None


class SolveForRequest(Part):
    """The field that is sought, and the output that shall have a value or be least or greatest."""

    exactly_one = ("equals", "extreme")
    endpoint: Annotated[str, Input("endpoint", text="the endpoint that is asked, as in GET /v1/examples")]
    request: Annotated[
        dict[str, Any], Input("request", text="the endpoint's request; the field that is sought may be left out")
    ]
    find: Annotated[Sought, Input("sought field", text="a number, or lubricant.name for an oil that was read")]
    output: Annotated[
        FieldPath,
        Input("output", text="dotted path of a number; heat.band.safety.0 is the worst end of the safety factor"),
    ]
    equals: Annotated[
        float | None, Input("wanted value", text="value that the output shall have", ge=-LARGEST, le=LARGEST)
    ] = None
    extreme: Annotated[Extreme | None, Input("extreme", text="find where the output is least or greatest")] = None
    count: Annotated[int, Input("points of the scan", text="more points find narrower answers", ge=3, le=500)] = 21
    oil_tests: Annotated[OilTests, OIL_TESTS] = "held"


Scale = Literal["linear", "log", "whole", "list", "oils"]


class Track(NamedTuple):
    """The places of a search, and their values of the field.

    A place is a share of the range from `low` to `high`, in even steps or (`log`) even ratios. With `listed` values it
    is an index.
    """

    scale: Scale
    low: float | None = None
    high: float | None = None
    listed: Sequence[Scalar] = ()

    def value(self, place: float) -> Scalar:
        if self.listed:
            return self.listed[round(place)]
        assert self.low is not None
        assert self.high is not None
        if place in {0.0, 1.0}:
            return self.high if place else self.low
        if self.scale == "log":
            return exp(log(self.low) + place * (log(self.high) - log(self.low)))
        value = self.low + place * (self.high - self.low)
        return 0.0 if place == self._zero else value

    @property
    def _zero(self) -> float | None:
        """The place of zero inside a linear range: what acts to both sides may have a narrow peak there."""
        if self.scale != "linear" or self.low is None or self.high is None or not self.low < 0.0 < self.high:
            return None
        return self.low / (self.low - self.high)

    def scan(self, count: int) -> tuple[float, ...]:
        """Return the places of the scan: all of a short list, else `count` of them or a few more in a list."""
        if not self.listed:
            places, zero = np.linspace(0.0, 1.0, count).tolist(), self._zero
            others = places if zero is None else [place for place in places if abs(place - zero) > SAME]
            return tuple(sorted(others if zero is None else [*others, zero]))
        last = len(self.listed) - 1
        if self.scale == "oils" or last < LIST_SCANNED * count:
            return tuple(map(float, range(last + 1)))
        return tuple(np.unique(np.linspace(0, last, count).round()).tolist())


@dataclass(slots=True)
class _Course:
    """What is known of a search: its values, why places have none, and the places in the order of the points."""

    search: Search
    tally: Tally
    reasons: dict[float, str] = field(default_factory=dict)
    asked: list[float] = field(default_factory=list)

    def add(self, place: float, point: Point, asked: int) -> None:
        (out,) = point.out
        is_solved = point.status in SOLVED and is_number(out)
        self.search.tell(place, float(out) if is_solved else None, asked)
        self.tally.add(point)
        if not is_solved:
            told = point.error["message"] if point.error else "the answer has no value of this output"
            self.reasons[place] = "no solution" if point.status == "no_solution" else told


class SolveFor(Study):
    """Where an output has a wanted value, or is least or greatest, along one input.

    The range is scanned, then narrowed. The line `end` has these members:

    - `answers`: every place where the output has the value, with the side of the value `before` and `after` it (-1
      below, 1 above, 0 at an end of the curve), and the `end` of the range at which it lies; or the extreme
    - `crossings`: where the output passes the value without having it: it jumps (`jump`), there is no solution (`gap`),
      or the field takes no value in between (`between`)
    - `nearest`: the place whose output is closest to the value
    - `gaps`: where there is no solution, and why
    - `constant`: true if the output does not depend on the field

    A load stage of a test belongs to one oil. If another oil is sought, the limits that follow from the stages of the
    case are `held`, or every oil gets the stages of the case (`by_stage`). The field `lubricant.name` stands for the
    oils whose data sheets were read, in the order of their viscosity; each brings its own stages.
    """

    path = "/v1/solve-for"
    summary = "The input at which an output has a wanted value, or is least or greatest"
    answer = "a line for the search, one for each point as it is solved, one for the end"
    model = SolveForRequest
    body: SolveForRequest

    def _outputs(self, base: BaseRequest) -> tuple[Leaf, ...]:
        output = base.output(self.body.output, "output")
        if output.kind not in NUMBERS:
            raise Unprocessable("unknown_output", f"{output.path} is not a number; choose another output", "output")
        return (output,)

    def _planned(self, base: BaseRequest, most: int) -> int:
        find, output = self.body.find, self.outputs[0].path
        self.leaves = tuple(base.leaf(path, "find.path") for path in find.paths)
        case = base.described()
        self.held: Overrides = {}  # limits of the case's oil
        self.oils: dict[str, Overrides] = {}
        if find.paths == [NAME]:
            self.oils = _oils(base, case, find, output)
            self.track = Track("oils", listed=[*self.oils])
        else:
            self.track = _track(find, self.leaves, case)
        self.scan = self.track.scan(self.body.count)
        request = case or base.checked(self.overrides(self.track.value(self.scan[0])))
        self.tests = {} if self.oils else tests_moved(request, find.paths, [output])
        check_count(len(self.scan) + MOST_STEPS, most, "count")
        return len(self.scan)

    def overrides(self, value: Any) -> Overrides:
        """Return what a value of the field changes in the request, with the limits that are held."""
        if self.oils:
            return self.oils[value]
        return {**self.held, **{leaf.path: value for leaf in self.leaves}}

    @property
    def is_scanned_whole(self) -> bool:
        """Whether the scan has every value of the field, so that nothing is left to search."""
        return len(self.scan) == len(self.track.listed)

    def rank(self, value: Any) -> float:
        """Return where a value of the field stands among all values."""
        return float([*self.oils].index(value) if self.oils else value)

    async def lines(self, pool: Pool, clock: Clock) -> Lines:
        """Yield the header, a line for each point as it is solved, and the line `end`."""
        self.held = {}
        first = self.overrides(self.track.value(self.scan[0]))
        await self._size_flow(pool, first)
        try:
            if self.tests and self.body.oil_tests == "held":
                self.held = await hold(pool, self.question, self.tests, first)
        except Unprocessable as error:
            yield [clock.error(error.code, error.message)]
            return
        yield [self._header()]
        search = Search(self.scan, self.body.equals, self.body.extreme, whole=bool(self.track.listed))
        course = _Course(search, Tally(self.question.outputs))
        while (step := await self._next(pool, course)).places:
            start = len(course.asked)
            course.asked += step.places
            usual = len(self.scan) + (0 if self.is_scanned_whole else USUAL_STEPS)
            clock.total = max(len(course.asked), usual)
            async for lines in self._solved(pool, clock, course, range(start, len(course.asked)), step.asked):
                yield lines
        clock.total = len(course.asked)
        yield [{**self._end(course), "elapsed_s": clock.elapsed_s}]

    async def _next(self, pool: Pool, course: _Course) -> Step:
        """Return the next step of the search; none once it took too many."""
        if len(course.asked) >= len(self.scan) + MOST_STEPS:
            return Step(0, [])
        step: Step = await runner.twice_if_lost(pool, next_step, course.search)
        return step

    async def _solved(self, pool: Pool, clock: Clock, course: _Course, indices: range, asked: int) -> Lines:
        """Solve the places with these indices, and yield a line for each."""

        def value(index: int) -> Scalar:
            return self.track.value(course.asked[index])

        runs = runner.in_order(pool, self.question, lambda index: self.overrides(value(index)), indices, clock)
        async with aclosing(runs):
            async for chunk, points in runs:
                pairs = [*zip(chunk, points, strict=True)]
                for index, point in pairs:
                    course.add(course.asked[index], point, asked)
                yield [runner.point_line(index, value(index), point) for index, point in pairs]

    def _header(self) -> Line:
        find, track = self.body.find, self.track
        listed = [*track.listed] if track.scale in {"list", "oils"} else None
        named = {"path": find.path, "unit": common_unit(self.leaves), "title": self.leaves[0].title}
        return self.header(
            find={**named, "min": track.low, "max": track.high, "scale": track.scale, "values": listed},
            outputs=[output_header(self.outputs[0])],
            equals=self.body.equals,
            extreme=self.body.extreme,
            held=self.held,
            total=self.total,
        )

    def _end(self, course: _Course) -> Line:
        """Return the last line, without the time that the study took."""
        search, tally = course.search, course.tally
        answers, crossings = self._found(search)
        nearest = search.nearest
        gaps = []
        for is_gap, group in groupby(search.curve(OUTLINE), key=lambda pair: pair[1] is None):
            if is_gap:
                places = [place for place, _ in group]
                ends = {"from": self.track.value(places[0]), "to": self.track.value(places[-1])}
                gaps.append({**ends, "reason": Counter(course.reasons[place] for place in places).most_common(1)[0][0]})
        return {
            "type": "end",
            "points": len(course.asked),
            "counts": dict(sorted(tally.counts.items())),
            "answers": answers,
            "crossings": crossings,
            "nearest": nearest and self._reached(*nearest),
            "constant": search.is_constant,
            "gaps": gaps,
            "assumptions": list(tally.assumptions.values()),
            "remarks": remarks_on(self.tests, self.held),
        }

    def _reached(self, place: float, output: float) -> Line:
        """Return a place as values of field and output, with the end of the range at which it lies."""
        end = "min" if place == self.scan[0] else "max" if place == self.scan[-1] else None
        return {"at": self.track.value(place), "out": output, "end": None if self.oils else end}

    def _found(self, search: Search) -> tuple[list[Line], list[Line]]:
        """Return the answers and the crossings of the wanted value."""
        if search.extreme is not None:
            best = None if search.is_constant else search.nearest
            return ([self._reached(*best)] if best else []), []
        if self.oils:
            keeps = -1 if self.outputs[0].view.bound == "upper" else 1
            return [self._reached(*pair) for pair in search.solved if search.side(pair[1]) * keeps >= 0], []
        answers, crossings = found(search)
        value = self.track.value
        return [
            {
                **self._reached(answer.place, answer.output),
                "until": value(answer.until) if answer.until > answer.place else None,
                "before": answer.before,
                "after": answer.after,
            }
            for answer in answers
        ], [{"kind": each.kind, "between": [*map(value, each.places)], "out": [*each.outputs]} for each in crossings]


def _oils(base: BaseRequest, case: Request | None, find: Sought, output: str) -> dict[str, Overrides]:
    """Return what each named oil changes, by its name; the thinnest first."""
    if given := next((name for name in ("min", "max", "scale") if getattr(find, name) is not None), None):
        raise Unprocessable("values_or_range", "an oil is no number; leave the range out", f"find.{given}")
    oils = candidates(base.calculation.request, base.body, case or base.body, [output])
    if not oils:
        raise Unprocessable("no_oil", "no data sheet prints the load stages on which this output depends", "find.path")
    return {oil.name: changes for oil, changes in oils.items()}


def _track(find: Sought, leaves: tuple[Leaf, ...], case: Request | None) -> Track:
    """Return the values of a field among which the search looks; raise Unprocessable if it has no range of numbers."""
    leaf = leaves[0]
    numbers = [sorted(option for option in each.options if is_plain_number(option)) for each in leaves]
    for each, options in zip(leaves, numbers, strict=True):
        message = None if options else not_a_number(each)
        if message is not None or options != numbers[0] or each.kind != leaf.kind:
            text = message or "the fields do not take the same numbers; seek them one by one"
            raise Unprocessable("not_scalar", text, "find.path")
    low, high = _ends(find, leaf, numbers[0], None if case is None else value_at(case, leaf.path))
    for each in leaves if not numbers[0] else ():
        check_value(each, low, "find.min")
        check_value(each, high, "find.max")
    if low >= high:
        raise Unprocessable("values_or_range", "the value of min must be below the value of max", "find.min")
    if find.scale == "log" and low <= 0.0:
        raise Unprocessable("log_needs_positive", "both ends of a logarithmic scale must be above zero", "find.min")
    if numbers[0]:
        listed = [number for number in numbers[0] if low <= number <= high]
        if not listed:
            raise Unprocessable("out_of_range", f"{leaf.path}: no value lies between min and max", "find.min")
        return Track("list", low, high, listed)
    if leaf.kind == "integer":
        return Track("whole", low, high, range(int(low), int(high) + 1))
    is_wide = low > 0.0 and high >= WIDE * low
    return Track(find.scale or ("log" if is_wide else "linear"), low, high)


def _ends(find: Sought, leaf: Leaf, options: Sequence[float], value: Any) -> tuple[float, float]:
    """Return the ends of the range, with the usual ones where the request leaves them out."""
    least, most = (options[0], options[-1]) if options else whole_range(leaf)
    low, high = (least, most) if options else usual_range(leaf, value)
    if find.min is not None:
        low, high = find.min, high if find.min < high else most
    if find.max is not None:
        low, high = low if low < find.max or find.min is not None else least, find.max
    for name, end in {"min": low, "max": high}.items():
        if not isfinite(end):
            message = f"no range of {leaf.path} follows from the case; give {name}"
            raise Unprocessable("values_or_range", message, f"find.{name}")
    return low, high


def usual_range(leaf: Leaf, value: Any) -> tuple[float, float]:
    """Return the range around the value of the case in which a field is sought; the whole one without a value.

    What is never negative goes from a quarter of the value (from zero, where zero is permissible) to four times it;
    anything else by the value, at least by ten tolerances, to both sides.
    """
    low, high = whole_range(leaf)
    if not is_plain_number(value) or not isfinite(value):
        return low, high
    if low >= 0.0 and value > 0.0:
        start = 0.0 if low == 0.0 else value / FACTOR
        ends = start, FACTOR * value
    else:
        reach = max(abs(value), TOLERANCES * (leaf.declared.tolerance or 0.0)) or inf
        ends = value - reach, value + reach
    low, high = max(low, ends[0]), min(high, ends[1])
    return (ceil(low), floor(high)) if leaf.kind == "integer" else (low, high)
