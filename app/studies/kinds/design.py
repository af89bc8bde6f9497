"""Design: some inputs of a gear unit are varied, and the values with the best result in the worst case are sought.

A request may name any inputs. The page of the study varies only the inputs of the flank correction. The page shows the
best correction as a sheet for the grinder, and it shows the course of the search.
"""

from collections.abc import Sequence
from contextlib import aclosing
from math import ceil, floor, inf
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field
from scipy.optimize import NonlinearConstraint, minimize

from app.errors import Unprocessable
from app.figures.comparison import compared
from app.figures.data import Figure, NoFigure, values
from app.figures.studies import Lead, lead_chart, search
from app.figures.units import axis_of
from app.models.drive_train.figures import GAP, LOAD_ALONE
from app.pages.cases import Case
from app.pages.studies.controls import Control
from app.pages.studies.page import OUTPUT, Controls, Link, Number, Result, Table
from app.pages.study_kinds import StudyLink
from app.pages.typesetting import shown
from app.schema.fields import Leaf
from app.schema.quantities import Input
from app.studies import runner
from app.studies.fields import NUMBERS, check_value, not_a_number, value_at
from app.studies.kinds import corners
from app.studies.kinds.corners import UnitPage, load_figure
from app.studies.point_sets import common_unit, grid, listed
from app.studies.points import BaseRequest, check_count, check_distinct
from app.studies.requests import (
    DRIVE_TRAIN,
    RANGES,
    Cases,
    DriveTrainStudy,
    FieldPath,
    FieldPaths,
    FieldsTogether,
    Overrides,
    Ranges,
)
from app.studies.runner import Clock, Line, Lines, Pool, Study, output_header, paths_of
from solvers.arrays import FloatArray
from solvers.drive_train.uncertainty import MOST_CORNERS
from solvers.errors import NoSolution

FIRST_STEP = 0.15  # trust radius at the start of the search, as a share of the range of a variable
LAST_STEP = 2e-3  # trust radius at the end of the search, as a share of the range of a variable; chosen
LEAST_GAIN = 1e-3  # the search ends if a restart gains less than this share of the objective at the start
VALUE_SCALE = 0.2  # the unit of the scaled objectives, as a share of the objective at the start
PENALTY = 5.0  # scaled objective of a point without solution, minus the scaled objective of the worst point so far
MOST_STEPS = 100  # largest number of COBYQA steps per evaluation; a step that only moves the level is no evaluation

EVALUATIONS = 40  # default of the largest number of evaluations on the page; chosen
STEP_UM = 0.5  # the page rounds the best correction to multiples of this step
SLOPE, CROWNING = "modifications.helix_slope_um", "modifications.lead_crowning_um"
TIP, ROOT = "modifications.tip_relief_um", "modifications.root_relief_um"


class Variable(FieldsTogether):
    """A variable of the search: a field, or several fields with the same value, and the range of this value."""

    path: Annotated[FieldPaths, Input("field to choose", text="dotted path, or several fields of one value")]
    min: Annotated[float, Input("lower end")]
    max: Annotated[float, Input("upper end")]
    step: Annotated[
        float | None,
        Input("step", text="to what the best value is rounded, which is then judged once more", gt=0, le=1e6),
    ] = None


class DesignRequest(DriveTrainStudy):
    """A gear unit, the variables of its flank correction, and the cases in which a correction is judged."""

    variables: Annotated[list[Variable], Field(min_length=1, max_length=10), Input("variables")]
    corners: Annotated[Ranges, Input("corners", text=RANGES, default_text="the request's own")] = None
    collective: Annotated[
        Cases, Input("collective", text="operating points, as what each changes", default_text="the request's own")
    ] = None
    objective: Annotated[
        FieldPath, Input("objective", text="dotted path of the output that its worst corner judges")
    ] = "safety.minimum"
    direction: Annotated[
        Literal["maximise", "minimise"] | None,
        Input("direction", text="whether the objective shall be large or small", default_text="towards its safe side"),
    ] = None
    evaluations: Annotated[
        int, Input("evaluations", text="how many corrections may be tried at every corner", ge=1, le=1000)
    ] = 60


class Design(Study):
    """A search for the best correction of a gear unit. The search starts from the correction in the request.

    The objective of a correction is the value of the chosen output at the worst combination of operating point and
    corner. The output `safety.minimum` needs the thermal film, which takes one second per corner. If the output is
    `safety.blok_flank`, or if `model.lubrication` is `closed_form`, the search is twenty times as fast.

    If a variable has a `step`, the last line of the answer has the member `rounded`. This member holds the best
    correction, rounded to whole steps, and the objective of the rounded correction.
    """

    path = "/v1/drive-train/design"
    summary = "The correction of a gear unit that is best at its worst corner"
    answer = "a line for the search, one for each correction tried, and one for the end"
    model = DesignRequest
    body: DesignRequest

    def _outputs(self, base: BaseRequest) -> tuple[Leaf, ...]:
        """Return the output that is the objective. The study has no other outputs."""
        objective = base.output(self.body.objective, "objective")
        if objective.kind not in NUMBERS:
            raise Unprocessable(
                "unknown_output", f"{objective.path} is not a number; choose another objective", "objective"
            )
        return (objective,)

    def _planned(self, base: BaseRequest, most: int) -> int:
        body, (objective,) = self.body, self.outputs
        self.units = [_unit(variable, base, f"variables.{place}") for place, variable in enumerate(body.variables)]
        self.cases = _cases(body, base)
        case = base.checked(self.cases[0]).model_dump()
        if body.direction is None and objective.view.bound is None:
            message = (
                f"for {objective.path} it is not known whether large or small values are better; set direction to "
                "maximise or minimise"
            )
            raise Unprocessable("direction_missing", message, "direction")
        self.direction = body.direction or ("maximise" if objective.view.greatest_is_best else "minimise")
        self.start = [_share(variable, case) for variable in body.variables]  # start of the search in the unit cube
        self.is_rounded = any(variable.step is not None for variable in body.variables)
        total = (body.evaluations + self.is_rounded) * len(self.cases)
        check_count(total, most, "evaluations")
        return total

    async def lines(self, pool: Pool, clock: Clock) -> Lines:
        """Yield the header, a line for each correction tried, and the line `end`."""
        variables = zip(self.body.variables, self.units, strict=True)
        yield [
            self.header(
                variables=[
                    {"path": variable.paths, "unit": unit, "min": variable.min, "max": variable.max}
                    for variable, unit in variables
                ],
                objective=output_header(self.outputs[0]),
                direction=self.direction,
                corners=len(self.cases),
                evaluations=self.body.evaluations,
            )
        ]
        trials: list[Line] = []
        objectives: list[list[float] | None] = []
        place: list[float] | None = self.start
        await self._size_flow(pool, {**self._at(self._values(self.start)), **self.cases[0]})
        while place is not None:
            values = self._values(place)
            trial, signed = await self._trial(pool, clock, values)
            yield [{"type": "trial", "index": len(trials), **trial}]
            trials.append(trial)
            objectives.append(signed)
            if objectives[0] is None:
                message = (
                    "the search cannot start, because the gear unit as described has no solution at one of the corners"
                )
                yield [clock.error("no_start", message)]
                return
            place = await runner.twice_if_lost(pool, next_place, self.start, objectives, self.body.evaluations)
        best, _ = min(zip(trials, objectives, strict=True), key=lambda pair: max(pair[1] or [inf]))
        rounded: Line = {}
        if self.is_rounded:
            values = [_rounded(variable, best["at"][variable.paths[0]]) for variable in self.body.variables]
            rounded["rounded"], _ = await self._trial(pool, clock, values)
        yield [
            {
                "type": "end",
                "start": trials[0]["at"],
                "best": best["at"],
                "objective_start": trials[0]["objective"],
                "objective_best": best["objective"],
                "worst_corner": best["worst_corner"],
                "evaluations": len(trials),
                **rounded,
                "unsolved": objectives.count(None),
                "history": [{"at": trial["at"], "objective": trial["objective"]} for trial in trials],
                "elapsed_s": clock.elapsed_s,
            }
        ]

    def _values(self, place: list[float]) -> list[float]:
        """Return the values of the variables at a place, which holds a share of every range."""
        shares = zip(self.body.variables, place, strict=True)
        return [variable.min + share * (variable.max - variable.min) for variable, share in shares]

    def _at(self, values: list[float]) -> Overrides:
        """Return the fields that take the values of the variables."""
        pairs = zip(self.body.variables, values, strict=True)
        return {path: value for variable, value in pairs for path in variable.paths}

    async def _trial(self, pool: Pool, clock: Clock, values: list[float]) -> tuple[Line, list[float] | None]:
        """Evaluate a correction in all cases. Return a summary of the trial and the objectives of all cases.

        The summary states the values of the variables, the objective in the worst case, and the worst case itself. If
        the objective is to be maximised, the signs of the returned objectives are reversed, so that a smaller number
        is always better.

        If a case has no solution, the remaining cases are not evaluated. The summary then states this case as the
        worst case, with None as its objective. None is also returned instead of the objectives.
        """
        at = self._at(values)
        objectives: list[float] = []
        indices = range(len(self.cases))
        runs = runner.in_order(pool, self.question, lambda index: {**at, **self.cases[index]}, indices, clock)
        async with aclosing(runs):
            async for chunk, points in runs:
                for index, point in zip(chunk, points, strict=True):
                    (objective,) = point.out
                    if objective is None:
                        return {"at": at, "objective": None, "worst_corner": self.cases[index]}, None
                    objectives.append(objective)
        sign = 1.0 if self.direction == "minimise" else -1.0
        signed = [sign * objective for objective in objectives]
        worst = signed.index(max(signed))
        return {"at": at, "objective": objectives[worst], "worst_corner": self.cases[worst]}, signed


def _unit(variable: Variable, base: BaseRequest, place: str) -> str | None:
    """Check a variable, and return the common unit of its fields, or None if the units differ.

    Raises Unprocessable if a field does not accept the range of the variable, if the range is empty, or if no multiple
    of the step lies in the range.
    """
    leaves = [base.leaf(path, f"{place}.path") for path in variable.paths]
    for leaf in leaves:
        if leaf.kind != "number":
            message = (
                not_a_number(leaf)
                or f"{leaf.path} accepts only whole numbers, but the search needs a field that accepts all numbers"
            )
            raise Unprocessable("not_continuous", message, f"{place}.path")
        for name, end in {"min": variable.min, "max": variable.max}.items():
            check_value(leaf, end, f"{place}.{name}")
    if not variable.min < variable.max:
        raise Unprocessable("variable_range", "the value of min must be below the value of max", place)
    if variable.step is not None and floor(variable.max / variable.step) < ceil(variable.min / variable.step):
        raise Unprocessable(
            "variable_step",
            "no multiple of the step lies between min and max; choose a smaller step or a wider range",
            f"{place}.step",
        )
    return common_unit(leaves)


def _cases(request: DesignRequest, base: BaseRequest) -> list[Overrides]:
    """Return the cases, which are all combinations of an operating point and a corner.

    A case holds the values that replace values of the request.
    """
    corners: list[Overrides] = [{}]
    if request.corners is not None:
        combined = grid(request.corners, base, MOST_CORNERS, "corners")
        corners = [combined.overrides(index) for index in range(combined.total)]
    points = [{}] if request.collective is None else request.collective
    set_by_points = paths_of(listed(points, base, MOST_CORNERS, "collective").varied)
    check_count(len(points) * len(corners), MOST_CORNERS, "corners")
    changed = [path for variable in request.variables for path in variable.paths]
    for place, paths in {"variables": [], "corners": list(corners[0]), "collective": set_by_points}.items():
        changed += paths
        check_distinct(changed, place)
    return [{**point, **corner} for point in points for corner in corners]


def _share(variable: Variable, case: dict[str, Any]) -> float:
    """Return where the value of an input lies in the range of a variable, from 0 (lower end) to 1 (upper end).

    `case` holds the values of the inputs. If the input has no value, return 0.
    """
    own = value_at(case, variable.paths[0])
    return 0.0 if own is None else min(max((own - variable.min) / (variable.max - variable.min), 0.0), 1.0)


def _rounded(variable: Variable, value: float) -> float:
    """Round a value to the nearest multiple of the variable's step that lies inside the range of the variable.

    If the variable has no step, return the value itself.
    """
    step, low, high = variable.step, variable.min, variable.max
    if step is None:
        return value
    steps = min(max(round(value / step), ceil(low / step)), floor(high / step))
    return min(max(float(f"{steps * step:.12g}"), low), high)


class _Unknown(Exception):
    """Exception that stops the search if the objectives at a new point are needed. The argument is the new point."""


def next_place(start: Sequence[float], told: Sequence[list[float] | None], most: int) -> list[float] | None:
    """Return the point of the unit cube that the search evaluates next, or None if the search has ended.

    The search minimises the largest of the objectives, with at most `most` evaluations. `told` holds the objectives at
    all points evaluated so far, in the order of evaluation. An item of `told` is None if the point has no solution.
    Each call repeats the search from the beginning with the objectives in `told`, and stops at the first new point.
    The repetition takes some milliseconds per point. In return, no thread has to wait while objectives are computed.

    The method is COBYQA. It minimises an additional variable, the level, under the constraint that no objective
    exceeds the level. The method is restarted at the best point as long as a restart improves the result. Raises
    NoSolution with the code `design` if the starting point has no solution.
    """
    if len(told) == most:
        return None
    if (first := told[0]) is None:
        raise NoSolution("design", "the search cannot start, because the starting point has no solution")
    scale = VALUE_SCALE * abs(max(first)) or 1.0
    evaluated = {_name(np.array(start)): np.array(first) / scale}

    def scaled(place: FloatArray) -> FloatArray:
        """Return the scaled objectives at a point.

        `place` holds the coordinates of the point and, as its last item, the level. The level is not used here.
        """
        name = _name(place[:-1])
        if name not in evaluated:
            if len(evaluated) == len(told):
                raise _Unknown(np.clip(place[:-1], 0.0, 1.0).tolist())
            objectives = told[len(evaluated)]
            worst = max(float(others.max()) for others in evaluated.values())
            evaluated[name] = (
                np.full(len(first), worst + PENALTY) if objectives is None else np.array(objectives) / scale
            )
        return evaluated[name]

    def level(place: FloatArray) -> float:
        scaled(place)
        return float(place[-1])

    bounds = [*[(0.0, 1.0)] * len(start), (-np.inf, np.inf)]
    below = NonlinearConstraint(lambda place: scaled(place) - place[-1], -np.inf, 0.0)
    options: Any = {"maxfev": MOST_STEPS * most, "initial_tr_radius": FIRST_STEP, "final_tr_radius": LAST_STEP}
    before = np.inf
    while True:
        best = min(evaluated, key=lambda place: float(evaluated[place].max()))
        lowest = float(evaluated[best].max())
        if before - lowest < LEAST_GAIN / VALUE_SCALE:
            return None
        before = lowest
        x0 = np.append(np.frombuffer(best), lowest)
        try:
            minimize(level, x0, method="COBYQA", bounds=bounds, constraints=[below], options=options)
        except _Unknown as unknown:
            return list(unknown.args[0])


def _name(place: FloatArray) -> bytes:
    """Return a key for a point of the unit cube. Points that differ only by rounding errors have the same key."""
    return np.clip(place, 0.0, 1.0).round(12).tobytes()


# The corrections that may be ground. Each entry has a label, the fields that get the value of the correction, and the
# ends of the default range of the search [um]. The ranges are chosen. They are wider than the corrections that are
# usual for modules of a few millimetres. The user may change the ranges.
GROUND = (
    ("helix slope", (SLOPE,), -100.0, 100.0),
    ("crowning", (CROWNING,), 0.0, 20.0),
    ("relief at tip and root", (TIP, ROOT), 0.0, 30.0),
)
TRIALS = Control("trials", "evaluations", EVALUATIONS, label="corrections tried")
ENDS = tuple(
    control
    for place, (label, _, low, high) in enumerate(GROUND)
    for control in (
        Control(f"low.{place}", f"variables.{place}.min", low, label=f"{label}, from", unit="µm"),
        Control(f"high.{place}", f"variables.{place}.max", high, label=f"{label}, to", unit="µm"),
    )
)
"""Two controls per correction, for the ends of the range that is searched."""


class DesignPage(UnitPage):
    """The page that shows the flank correction with the best result at the worst corner."""

    link = StudyLink(
        corners.DESIGN,
        "What to grind",
        "the flank correction whose worst corner is best",
        place=5,
        endpoint=DRIVE_TRAIN,
    )
    question = "what to grind?"
    about = (
        "The search varies helix slope, crowning and relief. Each correction is judged at its worst corner of the "
        "uncertain inputs. The search starts from the correction of the case."
    )
    names = UnitPage.names | {control.name for control in (TRIALS, *ENDS)}
    figures = ("lead", LOAD_ALONE.name, GAP.name, "search")
    grows = True
    left_alone = ("pinion clearance", "wheel clearance", "thrust fraction")  # the uncertain inputs with least influence
    plan = Design

    def body(self) -> dict[str, Any]:
        """Return the body of the study's request.

        The body contains the ranges of the corrections and the values of the uncertain inputs. The user can type these
        ranges and values; otherwise the defaults are used. The inputs in `left_alone` have no defaults.
        """
        output, given = self.output, self.given()
        for (_, paths, *_), variable in zip(GROUND, given["variables"], strict=True):
            variable |= {"path": list(paths), "step": STEP_UM}
        return {
            "request": self.asked.body,
            **given,
            "objective": output.path,
            "direction": "maximise" if output.view.greatest_is_best else "minimise",
        }

    def declared(self) -> tuple[Control, ...]:
        """Return the controls for the number of trials, the ranges of the corrections and the uncertain inputs.

        Further items state where errors are shown. Errors of a correction are shown at the lower end of its range, and
        errors of the objective are shown at the menu of outputs.
        """
        whole = (Control(f"low.{place}", f"variables.{place}", sets=False) for place in range(len(GROUND)))
        objective = Control(OUTPUT.name, "objective", sets=False)
        return (TRIALS, *ENDS, *whole, objective, *super().declared())

    def controls(self) -> tuple[Controls, ...]:
        """Return two groups of form fields.

        One group contains the number of trials and the ranges of the corrections. The other group contains the values
        of the uncertain inputs.
        """
        fields = tuple(map(self.field_of, (TRIALS, *ENDS)))
        return Controls("Search", fields=fields), *super().controls()

    def result(self, lines: list[Line]) -> Result:
        """Return the sheet for the grinder, further tables, and figures of the lead, the load, the gap and the search.

        While the search runs, return only the best correction so far and the figure of the search.
        """
        trials = [line for line in lines if line["type"] == "trial"]
        solved_trials = [line for line in trials if line["objective"] is not None]
        if not solved_trials:
            return Result("")
        end, greatest = lines[-1], self.output.view.greatest_is_best
        objectives = [line["objective"] for line in trials]
        figure = {"search": search(axis_of(self.output), objectives, greatest=greatest)}
        if end["type"] != "end":
            best = (max if greatest else min)(solved_trials, key=lambda line: line["objective"])
            lead = Link("Open the unit ground so", self.address(best["at"]))
            return Result("", figure, first=(self._so_far(solved_trials[0], best),), leads=(lead,))
        wanted = end["rounded"]
        if wanted["objective"] is None:
            wanted = {"at": end["best"], "objective": end["objective_best"], "worst_corner": end["worst_corner"]}
        at, corner = wanted["at"], wanted["worst_corner"]
        case, ground = self.solved({}), self.solved(at)
        at_worst, as_described = self.solved({**at, **corner}), self.solved(trials[0]["worst_corner"])
        finding = "each at its worst corner, dashed as described: "
        figures = {
            "lead": self._lead_chart(case, at),
            **load_figure(at_worst, as_described, "ground so", finding),
            **_gap(ground, case),
            **figure,
        }
        unsolved = end["unsolved"]
        return Result(
            f"{end['evaluations']} corrections at {lines[0]['corners']} corners in {shown(end['elapsed_s'], 2)} s",
            figures,
            (_numbers(case, end, at), self.corner_table("The worst corner with this correction", ground, corner)),
            (f"{unsolved} of the corrections have a corner without solution.",) if unsolved else (),
            (
                Link("Open the unit ground so", self.address(at)),
                Link("Its report", self.address(at, "/report")),
                Link("Its worst corners", self.address(at, f"/{corners.CornersPage.link.name}")),
            ),
            first=(self._sheet(case, at), self._before_and_after(end, wanted, case, ground)),
        )

    def _so_far(self, start: Line, best: Line) -> Table:
        """Return the table that the page shows while the search runs: the best correction so far."""
        rows = []
        for path, value in best["at"].items():
            leaf = self.input(path)
            rows.append((leaf.title, shown(start["at"][path], 4), shown(value, 4), leaf.unit or ""))
        judged = f"{self.output.title}, at the worst corner"
        rows.append((judged, shown(start["objective"]), shown(best["objective"]), self.output.unit or ""))
        return Table("Best so far", ("correction", Number("as described"), Number("best so far"), "unit"), rows)

    def _sheet(self, case: Case, at: Overrides) -> Table:
        """Return the sheet for the grinder: gear, place on the flank, amount and tolerance of each correction."""
        inputs = case.response.inputs
        slope = float(at[SLOPE] or 0.0)
        deep, high = _ends(case) if slope < 0.0 else reversed(_ends(case))
        tip, wheel_tip = (
            f"tip relief, {shown(length)} mm along the line of action" if length is not None else "tip relief"
            for length in (value_at(inputs, path.replace("_um", "_length_mm")) for path in (TIP, ROOT))
        )
        entries = (
            (SLOPE, "pinion", "helix slope, over the face width", f"{deep} deeper than the {high}, straight between"),
            (CROWNING, "pinion", "helix crowning", "both ends deeper than the middle of the face"),
            (TIP, "pinion", tip, "tip deeper than the involute"),
            (ROOT, "wheel", wheel_tip, "tip deeper than the involute"),
        )
        rows = []
        for path, gear, feature, place in entries:
            leaf, described, amount = self.input(path), float(value_at(inputs, path) or 0.0), at[path]
            if path == SLOPE:  # for the slope, the column `where` shows the sign
                described, amount = -described if slope < 0.0 else described, abs(slope)
            numbers = (shown(described), shown(amount, 4), f"± {shown(leaf.declared.tolerance)}")
            rows.append((gear, feature, place, *numbers, leaf.unit or ""))
        numbered = map(Number, ("as described", "grind", "tolerance"))
        note = (
            'Only the working flanks are corrected. "Deeper" means that more material is removed. Corrections are '
            f"multiples of {STEP_UM:g} µm; the tolerances are usual for these corrections. Helix slope and crowning "
            "are the sums for both gears and are put on the pinion. Tip relief of the wheel replaces root relief of "
            "the pinion."
        )
        return Table("What to grind", ("gear", "correction", "where", *numbered, "unit"), rows, note)

    def _before_and_after(self, end: Line, wanted: Line, case: Case, ground: Case) -> Table:
        """Return a table that compares the output before and after the correction.

        One column is for the correction as entered, and one column is for the best correction. The first row states
        the output with the worst values of the uncertain inputs, and the second row with the values as entered. If the
        best correction worsens the output in the second row, the table has a note.
        """
        output = self.output
        before, after = (value_at(unit_case.response, output.path) for unit_case in (case, ground))
        unit, note = output.unit or "", ""
        rows = (
            ("at the worst corner of each", shown(end["objective_start"]), shown(wanted["objective"]), unit),
            ("with the inputs as described", shown(before), shown(after), unit),
        )
        if None not in {before, after} and (after < before if output.view.greatest_is_best else after > before):
            note = (
                "With the inputs as described the result is worse than before. The reason is that the correction is "
                "chosen for its worst corner; a flank that is right at this corner is not quite right elsewhere."
            )
        return Table("What it brings", (output.title, Number("as described"), Number("ground so"), "unit"), rows, note)

    def _lead_chart(self, case: Case, at: Overrides) -> Figure:
        """Return the figure of the lead, which is the sum of helix slope and crowning.

        The solid line is the lead to grind, with its tolerance band. The dashed line is the lead as entered.
        """
        curves, inputs = case.response.misalignment.curves, case.response.inputs
        position = values(curves.position_mm)
        wanted = Lead(*(float(at[path] or 0.0) for path in (SLOPE, CROWNING)))
        before = Lead(*(float(value_at(inputs, path) or 0.0) for path in (SLOPE, CROWNING)))
        tolerance = Lead(*(self.input(path).declared.tolerance or 0.0 for path in (SLOPE, CROWNING)))
        return lead_chart(values(curves.z_mm), position / position[-1], wanted, before, tolerance, _ends(case))


def _ends(case: Case) -> tuple[str, str]:
    """Return the names of both ends of the face. The end that meshes first comes first."""
    first, *_, last = case.response.misalignment.curves.z_mm
    drive = case.request.pinion_shaft.torque_position_mm
    if drive is None:
        return f"end at Z = {shown(first)} mm", f"end at Z = {shown(last)} mm"
    sides = ("drive end", "free end") if abs(first - drive) < abs(last - drive) else ("free end", "drive end")
    return f"{sides[0]} (Z = {shown(first)} mm)", f"{sides[1]} (Z = {shown(last)} mm)"


def _numbers(case: Case, end: Line, at: Overrides) -> Table:
    """Return a table that explains why the pages of a gear unit show different values of helix slope and crowning.

    Each row states one helix slope, one crowning, and the source of both values.
    """
    misalignment, inputs = case.response.misalignment, case.response.inputs
    estimate = "first estimate: inputs as described, load spread evenly over the face"
    entries = (
        ("as described", value_at(inputs, SLOPE), value_at(inputs, CROWNING)),
        (estimate, misalignment.recommended_helix_slope_um, misalignment.recommended_lead_crowning_um),
        ("best at the worst corner, as the search found it", end["best"][SLOPE], end["best"][CROWNING]),
        (f"to grind: the best in multiples of {STEP_UM:g} µm", at[SLOPE], at[CROWNING]),
    )
    return Table(
        "Which number is which",
        ("number", Number("helix slope, µm"), Number("helix crowning, µm")),
        tuple((name, shown(slope, 4), shown(crowning, 4)) for name, slope, crowning in entries),
        "A positive helix slope removes material at the end of the face that leaves the mesh last.",
    )


def _gap(ground: Case, case: Case) -> dict[str, Figure]:
    """Return the figure of the gap between the flanks over the face.

    Solid lines show the gap with the correction to grind, and dashed lines the gap with the correction as entered. In
    both calculations, the uncertain inputs have the values as entered. If one of the two
    calculations has no such figure, return an empty dictionary.
    """
    try:
        own, given = (GAP.figure(unit_case.request, unit_case.response) for unit_case in (ground, case))
    except NoFigure:
        return {}
    return {GAP.name: compared(own, given, "as described")}


PAGE = DesignPage
