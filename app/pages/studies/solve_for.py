"""The page of a search: the input at which a result has a wanted value, or is least or greatest."""

import json
from collections.abc import Sequence
from typing import Any

from app.errors import Unprocessable
from app.figures.data import Figure, Mark, Span, values
from app.figures.solving import oils, sought
from app.figures.studies import Coordinate, Grid
from app.figures.units import axis_of
from app.figures.wording import listed, number
from app.pages.charts import for_phones
from app.pages.form import FieldView
from app.pages.results import verdict_lines
from app.pages.studies.controls import Choice, Control, field_choices
from app.pages.studies.found import DIGITS, Found
from app.pages.studies.page import OUTPUT, Controls, Link, Number, Result, StudyPage, Table, titled
from app.pages.study_kinds import FIND, OIL_TESTS
from app.pages.study_links import Starter, StudyExample, studies_of, studies_of_case
from app.pages.typed import text_of
from app.pages.typesetting import shown
from app.schema.fields import Leaf, leaf_at, value_at
from app.studies.fields import is_plain_number
from app.studies.kinds.solve_for import FACTOR, SolveFor
from app.studies.oil_tests import NAME
from app.studies.runner import Line

MOST_LINKS = 4  # largest number of links to cases above the result
COUNT = 21  # default number of points of the scan
GOALS = (("", "equal to"), ("least", "least"), ("greatest", "greatest"))
FIELD = Control("x", "find.path", None, str)
FROM, TO = Control("x.from", "find.min", label="from"), Control("x.to", "find.max", label="to")
POINTS = Control("x.count", "count", COUNT, label="points of the scan")
STEPS = (("", "by the range"), ("linear", "even steps"), ("log", "even ratios"))
SCALE = Control("x.scale", "find.scale", None, str, label="steps", options=STEPS)
GOAL = Control("goal", "extreme", None, str, label="is", options=GOALS)
HELD_OR_NOT = (("", "its limits are held"), ("by_stage", "its test stages stay"))
TESTS = Control(OIL_TESTS, "oil_tests", None, str, label="if the oil varies", options=HELD_OR_NOT)


class SolveForPage(StudyPage):
    """The page that finds the input for a wanted result."""

    link = FIND
    question = "find an input"
    about = (
        "One field is sought: the value at which a result is as wanted, or least, or greatest. Every place where the "
        "curve passes the value is found; two answers between neighbouring points of the scan need more points."
    )
    figures = ("curve", "oils")
    grows = True
    needs = ("x",)
    choose = (
        "Choose the field that is sought, and the value that the result shall have. If no range is given, a number "
        f"above zero is sought up to {FACTOR:g} times its value in the case."
    )
    shows_title = "at which"
    plan = SolveFor
    study: SolveFor

    @property
    def usual_wanted(self) -> float | None:
        """The value that the output shall have if none is typed: well above a lower limit, or an upper limit."""
        output = self.output
        limit, good = verdict_lines(output.view, self.case)
        return good if output.view.greatest_is_best else limit

    def declared(self) -> tuple[Control, ...]:
        """Return the controls of the field, of the goal and of the tests of the oil."""
        output, path = Control(OUTPUT.name, "output", sets=False), Control("x", "find", sets=False)
        return (path, FIELD, FROM, TO, SCALE, POINTS, GOAL, Control("wanted", "equals", label="value"), TESTS, output)

    def body(self) -> dict[str, Any]:
        """Return the body with the field that is sought, the output, and the value or extreme that it shall have."""
        body: dict[str, Any] = {
            "endpoint": self.calculation.path,
            "request": self.asked.body,
            "output": self.output.path,
        }
        body |= self.given()
        if "extreme" in body:
            body.pop("equals", None)
        elif "equals" not in body:
            if self.usual_wanted is None:
                raise Unprocessable("missing", "give the value that the output shall have", "equals")
            body["equals"] = self.usual_wanted
        return body

    def controls(self) -> tuple[Controls, ...]:
        """Return the menu of fields, with the form fields of the range."""
        leaf = self.field_at(self.views.get("x", ""))
        low, high = (None, None)
        if leaf and leaf.path != NAME:
            track = self.study and self.study.track
            low, high = (track.low, track.high) if track else (None, None)
        unit = (leaf.unit or "") if leaf else ""
        ends = tuple(
            self.field_of(part._replace(default=None if end is None else float(f"{end:.4g}"), unit=unit))
            for part, end in ((FROM, low), (TO, high))
        )
        choices = field_choices(self.calculation, self.case, texts=False)
        if leaf_at(self.calculation.request, NAME):
            choices.append(Choice(NAME, "oil whose data sheet was read, with its own test stages", "oils"))
        menu = self.menu("x", "field", "choose …", choices)
        return (Controls("Find the", menu, (*ends, self.field_of(SCALE), self.field_of(POINTS))),)

    def starters(self) -> Sequence[Starter | StudyExample]:
        """Return links to ready searches; without any, and without a case, the examples."""
        if self.asked.pairs:
            return studies_of_case(self.calculation, self.asked.pairs, self.case, pages=[FIND.name])
        return studies_of(self.calculation, FIND.name) or super().starters()

    def shows(self) -> tuple[FieldView, ...]:
        """Return the form fields of the goal."""
        try:
            usual, unit = self.usual_wanted, self.output.unit or ""
        except Unprocessable:  # the query names no output
            usual, unit = None, ""
        wanted = self.field("wanted", "value", None if usual is None else float(f"{usual:.4g}"), unit)
        tests = (self.field_of(TESTS),) if self.views.get(OIL_TESTS) or (self.study and self.study.tests) else ()
        return self.field_of(GOAL), wanted, *tests

    def result(self, lines: list[Line]) -> Result:
        """Return the answer, links to its cases, the curve and a table of the points."""
        points, end = [line for line in lines if line["type"] == "point"], lines[-1]
        if end["type"] != "end":
            return Result("", self._figures(points, None))
        found = Found(self.leaf, self.output, lines[0], end, points)
        remarks = [f"{remark}." for remark in end["remarks"]]
        remarks += [f"No solution {found.span(gap)}: {gap['reason']}." for gap in end["gaps"]]
        return Result(
            f"{end['points']} points in {shown(end['elapsed_s'], 2)} s",
            self._figures(points, end),
            (self._table(points),),
            tuple(remarks),
            (*self._links(found), *(self.oil_links(held=bool(self.study.held)) if self.study.tests else ())),
            script="" if self.study.oils else self._script(points),
            answer=found.answer(),
        )

    @property
    def leaf(self) -> Leaf:
        """The field that is sought."""
        return self.study.leaves[0]

    def _links(self, found: Found) -> list[Link]:
        """Return links to the cases of the answers; without an answer, a link that searches beyond the nearest end."""
        end = found.end
        links = [
            Link(f"Open the case with {found.value(at)}", self.address(self.study.overrides(at)))
            for at in found.to_open()[:MOST_LINKS]
        ]
        nearest = end["nearest"]
        is_best_at_end = len(end["answers"]) == 1 and found.header["extreme"] and not self.study.oils
        is_far = not links and not found.levels_off
        if nearest and nearest["end"] and not end["constant"] and (is_far or is_best_at_end):
            links += self._further(found.beyond(nearest["end"]))
        return links

    def _further(self, ends: tuple[float, float] | None) -> list[Link]:
        """Return a link that searches in a range beyond an end, unless there is no such range."""
        if ends is None:
            return []
        first, last = (float(f"{each:.4g}") for each in ends)
        address = self.other(FIND, **{FROM.name: text_of(first), TO.name: text_of(last), SCALE.name: ""})
        return [Link(f"Search from {number(first)} to {number(last, self.leaf.unit)}", address)]

    def _figures(self, points: list[Line], end: Line | None) -> dict[str, Figure]:
        """Return the curve of the points so far with the answers, or the bars of the oils; nothing without points."""
        if not points:
            return {}
        output, wanted = axis_of(self.output), self.study.body.equals
        if self.study.oils:
            named = [(line["at"], line["out"][0]) for line in points if is_plain_number(line["out"][0])]
            reaching = {each["at"] for each in end["answers"]} if end else ()
            reach = [place for place, (name, _) in enumerate(named) if name in reaching]
            finding = f"{len(reach)} of {len(named)} reach {number(wanted, output.unit)}" if end and wanted else ""
            return {"oils": oils(output, named, wanted, min(reach, default=0), finding)}
        ordered = sorted(points, key=lambda line: float(line["at"]))
        places = [float(line["at"]) for line in ordered]
        limit, good = verdict_lines(self.output.view, self.case)
        own = value_at(self.case, self.leaf.path)
        track = self.study.track
        x = axis_of(
            self.leaf,
            log=track.scale == "log" or (track.scale == "list" and places[0] > 0.0),
            magnitude=False,
            ticks=places if track.scale == "list" else None,
        )
        grid = Grid(
            Coordinate(x, values(places), own=float(own) if is_plain_number(own) else None),
            None,
            output,
            values([line["out"][0] for line in ordered]),
            limit=limit,
            good=good,
            greatest=self.output.view.greatest_is_best,
            unsolved=sum(line["out"][0] is None for line in ordered),
        )
        marks = [] if end is None else [self._mark(each) for each in end["answers"]]
        goal = self.study.body.extreme or number(wanted or 0.0, self.output.unit)
        finding = f"{goal} at {listed([mark.text for mark in marks])}" if marks else ""
        between = [each["between"] for each in end["crossings"] if each["kind"] == "between"] if end else []
        if between and not marks:
            finding = f"{goal} between {' and '.join(number(at, digits=DIGITS) for at in between[0])}"
        return {"curve": sought(grid, wanted, marks, _gaps(ordered), finding)}

    def _mark(self, answer: Line) -> Mark:
        return Mark(float(answer["at"]), answer["out"], number(float(answer["at"]), self.leaf.unit, digits=DIGITS))

    def _table(self, points: list[Line]) -> Table:
        rows = []
        for line in sorted(points, key=lambda line: self.study.rank(line["at"])):
            at = shown(line["at"], 6)
            link = Link("open", self.address(self.study.overrides(line["at"])), f"open the case at {at}")
            reason = line["error"]["message"] if "error" in line else line["status"].replace("_", " ")
            rows.append((at, shown(line["out"][0]), reason, link))
        return Table(
            "Points", (Number(titled(self.leaf)), Number(titled(self.output)), "status", "case"), rows, folded=True
        )

    def _script(self, points: list[Line]) -> str:
        """Return the data for the script of the page, as JSON. The script opens the case at the mouse pointer."""
        from app.figures.drawing.image import places as places_of  # noqa: PLC0415  only workers draw

        ordered = sorted(points, key=lambda line: float(line["at"]))
        figure = self._figures(points, None)["curve"]
        (place,), (narrow,) = places_of(figure), places_of(for_phones(figure))
        leaf = self.leaf
        content = {
            "address": self.asked.root + self.address(self.study.overrides(ordered[0]["at"])),
            "axes": [
                {"path": leaf.path, "name": leaf.title, "unit": leaf.unit or "", "at": [line["at"] for line in ordered]}
            ],
            "out": [line["out"][0] for line in ordered],
            "title": self.output.title,
            "unit": self.output.unit or "",
            "map": False,
            "box": place.box,
            "narrow": narrow.box,
            "ranges": [place.x, place.y],
        }
        return json.dumps(content)


def _gaps(ordered: list[Line]) -> list[Span]:
    """Return the ranges without a solution, each up to the solved points beside it."""
    spans, last, start = list[Span](), None, None
    for line in ordered:
        at = float(line["at"])
        if line["out"][0] is None:
            start = start if start is not None else at if last is None else last
            end = at
        else:
            if start is not None:
                spans.append(Span(start, at, "no solution"))
            last, start = at, None
    return [*spans, Span(start, end, "no solution")] if start is not None else spans
