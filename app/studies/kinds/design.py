"""Design: values of some inputs whose worst case is best, searched trial by trial.

On its page they are the flank correction of a gear unit, as a sheet for the grinder, and how it was found.
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
from app.figures.models.drive_train import GAP, LOAD_ALONE
from app.figures.studies import Lead, lead_chart, search
from app.figures.units import axis_of
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

FIRST_STEP = 0.15  # of a variable's range
LAST_STEP = 2e-3  # of a variable's range, chosen
LEAST_GAIN = 1e-3  # of the objective at the start; a restart that gained less is the last
VALUE_SCALE = 0.2  # of the objective at the start: a change that counts as much as a variable's whole range
PENALTY = 5.0  # scaled, above the worst known objective: that of a point without solution
MOST_STEPS = 100  # of COBYQA for each evaluation; steps that change the level alone need no evaluation

EVALUATIONS = 40  # offered on the page at first, chosen
STEP_UM = 0.5  # to which a correction is rounded
SLOPE, CROWNING = "modifications.helix_slope_um", "modifications.lead_crowning_um"
TIP, ROOT = "modifications.tip_relief_um", "modifications.root_relief_um"


class Variable(FieldsTogether):
    """A number that the search varies, and its range."""

    path: Annotated[FieldPaths, Input("field to choose", text="dotted path, or several fields of one value")]
    min: Annotated[float, Input("lower end")]
    max: Annotated[float, Input("upper end")]
    step: Annotated[
        float | None,
        Input("step", text="to what the best value is rounded, which is then judged once more", gt=0, le=1e6),
    ] = None


class DesignRequest(DriveTrainStudy):
    """The flank correction whose worst corner is best."""

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
    """A search with COBYQA that starts from the request's own correction.

    The objective of a correction is its value at the worst operating point and corner. `safety.minimum` needs the
    thermal film, a second a corner; with `safety.blok_flank`, or `model.lubrication` in closed form, the search is
    twenty times as fast. Where variables have a `step`, `rounded` in the last line is the best correction in whole
    steps, calculated like the others.
    """

    path = "/v1/drive-train/design"
    summary = "The correction of a gear unit that is best at its worst corner"
    answer = "a line for the search, one for each correction tried, and one for the end"
    model = DesignRequest
    body: DesignRequest

    def _outputs(self, base: BaseRequest) -> tuple[Leaf, ...]:
        """The objective."""
        objective = base.output(self.body.objective, "objective")
        if objective.kind not in NUMBERS:
            raise Unprocessable("unknown_output", f"{objective.path} is not a number", "objective")
        return (objective,)

    def _planned(self, base: BaseRequest, most: int) -> int:
        body, (objective,) = self.body, self.outputs
        self.units = [_unit(each, base, f"variables.{place}") for place, each in enumerate(body.variables)]
        self.cases = _cases(body, base)
        case = base.checked(self.cases[0]).model_dump()
        if body.direction is None and objective.view.bound is None:
            message = f"{objective.path} has no safe side of its own; state whether to maximise or minimise it"
            raise Unprocessable("direction_missing", message, "direction")
        self.direction = body.direction or ("maximise" if objective.view.greatest_is_best else "minimise")
        self.start = [_share(variable, case) for variable in body.variables]  # of the ranges
        self.is_rounded = any(variable.step is not None for variable in body.variables)
        total = (body.evaluations + self.is_rounded) * len(self.cases)
        check_count(total, most, "evaluations")
        return total

    async def lines(self, pool: Pool, clock: Clock) -> Lines:
        """The header, a line for each trial, the end."""
        variables = zip(self.body.variables, self.units, strict=True)
        yield [
            self.header(
                variables=[{"path": of.paths, "unit": unit, "min": of.min, "max": of.max} for of, unit in variables],
                objective=output_header(self.outputs[0]),
                direction=self.direction,
                corners=len(self.cases),
                evaluations=self.body.evaluations,
            )
        ]
        trials: list[Line] = []
        figures: list[list[float] | None] = []
        place: list[float] | None = self.start
        while place is not None:
            shares = zip(self.body.variables, place, strict=True)
            values = [each.min + share * (each.max - each.min) for each, share in shares]
            trial, found = await self._trial(pool, clock, values)
            yield [{"type": "trial", "index": len(trials), **trial}]
            trials.append(trial)
            figures.append(found)
            if figures[0] is None:
                message = "the unit that the search starts from has no answer at its worst corner"
                yield [clock.error("no_start", message)]
                return
            place = await runner.twice_if_lost(pool, next_place, self.start, figures, self.body.evaluations)
        best, _ = min(zip(trials, figures, strict=True), key=lambda each: max(each[1] or [inf]))
        rounded: Line = {}
        if self.is_rounded:
            values = [_rounded(each, best["at"][each.paths[0]]) for each in self.body.variables]
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
                "unsolved": figures.count(None),
                "history": [{"at": each["at"], "objective": each["objective"]} for each in trials],
                "elapsed_s": clock.elapsed_s,
            }
        ]

    async def _trial(self, pool: Pool, clock: Clock, values: list[float]) -> tuple[Line, list[float] | None]:
        """The values of the variables, the objective at their worst case, and that case; null without a solution.

        Behind them the objectives of all cases with the sign that the search minimises; None where the first case
        without solution ended the trial.
        """
        pairs = zip(self.body.variables, values, strict=True)
        at: Overrides = {path: value for variable, value in pairs for path in variable.paths}
        objectives: list[float] = []
        indices = range(len(self.cases))
        runs = runner.in_order(pool, self.question, lambda index: {**at, **self.cases[index]}, indices, clock)
        async with aclosing(runs):
            async for solved, points in runs:
                for index, point in zip(solved, points, strict=True):
                    (objective,) = point.out
                    if objective is None:
                        return {"at": at, "objective": None, "worst_corner": self.cases[index]}, None
                    objectives.append(objective)
        sign = 1.0 if self.direction == "minimise" else -1.0
        figures = [sign * objective for objective in objectives]
        worst = figures.index(max(figures))
        return {"at": at, "objective": objectives[worst], "worst_corner": self.cases[worst]}, figures


def _unit(variable: Variable, base: BaseRequest, place: str) -> str | None:
    """The common unit of the fields of a variable, whose range they take."""
    leaves = [base.leaf(path, f"{place}.path") for path in variable.paths]
    for leaf in leaves:
        if leaf.kind != "number":
            message = not_a_number(leaf) or f"{leaf.path} takes only whole numbers; the search needs a continuous field"
            raise Unprocessable("not_continuous", message, f"{place}.path")
        for name, end in {"min": variable.min, "max": variable.max}.items():
            check_value(leaf, end, f"{place}.{name}")
    if not variable.min < variable.max:
        raise Unprocessable("variable_range", "a variable needs a range from min to max", place)
    if variable.step is not None and floor(variable.max / variable.step) < ceil(variable.min / variable.step):
        raise Unprocessable("variable_step", "no multiple of the step lies between min and max", f"{place}.step")
    return common_unit(leaves)


def _cases(request: DesignRequest, base: BaseRequest) -> list[Overrides]:
    """Every operating point at every corner."""
    corners: list[Overrides] = [{}]
    if request.corners is not None:
        combined = grid(request.corners, base, MOST_CORNERS, "corners")
        corners = [combined.overrides(index) for index in range(combined.total)]
    points = [{}] if request.collective is None else request.collective
    set_by_points = paths_of(listed(points, base, MOST_CORNERS, "collective").varied)
    check_count(len(points) * len(corners), MOST_CORNERS, "corners")
    known = [path for variable in request.variables for path in variable.paths]
    for place, paths in {"variables": [], "corners": list(corners[0]), "collective": set_by_points}.items():
        known += paths
        check_distinct(known, place)
    return [{**point, **corner} for point in points for corner in corners]


def _share(variable: Variable, case: dict[str, Any]) -> float:
    """The case's own value as a share of the range; 0 where it has none."""
    own = value_at(case, variable.paths[0])
    return 0.0 if own is None else min(max((own - variable.min) / (variable.max - variable.min), 0.0), 1.0)


def _rounded(variable: Variable, value: float) -> float:
    """The nearest multiple of the variable's step inside its range, or the value itself where there is no step."""
    step, low, high = variable.step, variable.min, variable.max
    if step is None:
        return value
    steps = min(max(round(value / step), ceil(low / step)), floor(high / step))
    return min(max(float(f"{steps * step:.12g}"), low), high)


class _Unknown(Exception):
    """The search needs the objectives at a point, the argument."""


def next_place(start: Sequence[float], told: Sequence[list[float] | None], most: int) -> list[float] | None:
    """The point of the unit cube that the search evaluates next, or None at its end; runs in a worker.

    The search minimises the largest objective with at most so many evaluations. `told` are the objectives at the points
    before, from the start on, None where there is no solution: the search is repeated up to there, which takes some
    milliseconds a point and needs no thread that waits.
    COBYQA, which needs no derivatives, minimises a level under the constraints that no objective exceeds it: each
    objective has a smooth model of its own, also along a ridge where two are equally large. It is restarted at the best
    point as long as that gains anything. Raises NoSolution design where the start has no solution.
    """
    if len(told) == most:
        return None
    if (first := told[0]) is None:
        raise NoSolution("design", "the point where the search starts has no solution")
    scale = VALUE_SCALE * abs(max(first)) or 1.0
    known = {_name(np.array(start)): np.array(first) / scale}

    def scaled(place: FloatArray) -> FloatArray:
        """The objectives at a place, whose last component is the level."""
        name = _name(place[:-1])
        if name not in known:
            if len(known) == len(told):
                raise _Unknown(np.clip(place[:-1], 0.0, 1.0).tolist())
            found = told[len(known)]
            worst = max(float(each.max()) for each in known.values())
            known[name] = np.full(len(first), worst + PENALTY) if found is None else np.array(found) / scale
        return known[name]

    def level(place: FloatArray) -> float:
        scaled(place)
        return float(place[-1])

    bounds = [*[(0.0, 1.0)] * len(start), (-np.inf, np.inf)]
    below = NonlinearConstraint(lambda place: scaled(place) - place[-1], -np.inf, 0.0)
    options: Any = {"maxfev": MOST_STEPS * most, "initial_tr_radius": FIRST_STEP, "final_tr_radius": LAST_STEP}
    before = np.inf
    while True:
        best = min(known, key=lambda place: float(known[place].max()))
        lowest = float(known[best].max())
        if before - lowest < LEAST_GAIN / VALUE_SCALE:
            return None
        before = lowest
        x0 = np.append(np.frombuffer(best), lowest)
        try:
            minimize(level, x0, method="COBYQA", bounds=bounds, constraints=[below], options=options)
        except _Unknown as unknown:
            return list(unknown.args[0])


def _name(place: FloatArray) -> bytes:
    """A place in the unit cube, the same for those that only rounding tells apart."""
    return np.clip(place, 0.0, 1.0).round(12).tobytes()


# What may be ground: label, fields of one value, and the range searched when none is given [um]. The ranges are chosen:
# wider than what is ground of teeth of a few millimetres of module, and the user may change them.
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
"""Between which values each of them is searched."""


class DesignPage(UnitPage):
    """The flank correction whose worst corner is best."""

    link = StudyLink(
        corners.DESIGN,
        "What to grind",
        "the flank correction whose worst corner is best",
        place=5,
        endpoint=DRIVE_TRAIN,
    )
    question = "what to grind?"
    about = (
        "A search for helix slope, crowning and relief, each judged at its worst corner of the uncertain inputs. It "
        "starts from the correction of the case."
    )
    names = UnitPage.names | {control.name for control in (TRIALS, *ENDS)}
    figures = ("lead", LOAD_ALONE.name, GAP.name, "search")
    grows = True
    left_alone = ("pinion clearance", "wheel clearance", "thrust fraction")  # they change the result least
    plan = Design

    def body(self) -> dict[str, Any]:
        """The ranges as typed or usual, at the corners as typed or the usual ones of heat and couplings."""
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
        """How many corrections are tried, the ranges of what may be ground, and the uncertain inputs."""
        whole = (Control(f"low.{place}", f"variables.{place}", sets=False) for place in range(len(GROUND)))
        objective = Control(OUTPUT.name, "objective", sets=False)
        return (TRIALS, *ENDS, *whole, objective, *super().declared())

    def controls(self) -> tuple[Controls, ...]:
        """Ranges of what may be ground, how many corrections are tried, and the uncertain inputs."""
        fields = tuple(map(self.field_of, (TRIALS, *ENDS)))
        return Controls("Search", fields=fields), *super().controls()

    def result(self, lines: list[Line]) -> Result:
        """The grinding sheet, its effect, the numbers before and after; figures of lead, load, gap and search."""
        trials = [line for line in lines if line["type"] == "trial"]
        solved = [line for line in trials if line["objective"] is not None]
        if not solved:
            return Result("")
        end, greatest = lines[-1], self.output.view.greatest_is_best
        objectives = [line["objective"] for line in trials]
        figure = {"search": search(axis_of(self.output), objectives, greatest=greatest)}
        if end["type"] != "end":
            best = (max if greatest else min)(solved, key=lambda line: line["objective"])
            lead = Link("Open the unit ground so", self.address(best["at"]))
            return Result("", figure, first=(self._so_far(solved[0], best),), leads=(lead,))
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
            (f"{unsolved} of the corrections had a corner without solution.",) if unsolved else (),
            (
                Link("Open the unit ground so", self.address(at)),
                Link("Its report", self.address(at, "/report")),
                Link("Its worst corners", self.address(at, f"/{corners.CornersPage.link.name}")),
            ),
            first=(self._sheet(case, at), self._before_and_after(end, wanted, case, ground)),
        )

    def _so_far(self, start: Line, best: Line) -> Table:
        """The best correction found, before the search has ended."""
        rows = []
        for path, value in best["at"].items():
            leaf = self.input(path)
            rows.append((leaf.title, shown(start["at"][path], 4), shown(value, 4), leaf.unit or ""))
        judged = f"{self.output.title}, at the worst corner"
        rows.append((judged, shown(start["objective"]), shown(best["objective"]), self.output.unit or ""))
        return Table("Best so far", ("correction", Number("as described"), Number("best so far"), "unit"), rows)

    def _sheet(self, case: Case, at: Overrides) -> Table:
        """What to grind: gear, place, amount and tolerance."""
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
            if path == SLOPE:  # `where` says the sign
                described, amount = -described if slope < 0.0 else described, abs(slope)
            numbers = (shown(described), shown(amount, 4), f"± {shown(leaf.declared.tolerance)}")
            rows.append((gear, feature, place, *numbers, leaf.unit or ""))
        numbered = map(Number, ("as described", "grind", "tolerance"))
        note = (
            f"Working flanks only; deeper: more material removed. Multiples of {STEP_UM:g} µm; tolerances are those "
            "usual for these corrections. Helix slope and crowning are the sum of both gears, here all on the pinion; "
            "tip relief of the wheel stands for root relief of the pinion."
        )
        return Table("What to grind", ("gear", "correction", "where", *numbered, "unit"), rows, note)

    def _before_and_after(self, end: Line, wanted: Line, case: Case, ground: Case) -> Table:
        """The output before and after grinding, at the worst corner and as described; a note where it gets worse."""
        output = self.output
        before, after = (value_at(each.response, output.path) for each in (case, ground))
        unit, note = output.unit or "", ""
        rows = (
            ("at the worst corner of each", shown(end["objective_start"]), shown(wanted["objective"]), unit),
            ("with the inputs as described", shown(before), shown(after), unit),
        )
        if None not in {before, after} and (after < before if output.view.greatest_is_best else after > before):
            note = (
                "With the inputs as described it is worse than before: the correction is sized for the corner that is "
                "worst for it, and a flank that is right there is not quite right elsewhere."
            )
        return Table("What it brings", (output.title, Number("as described"), Number("ground so"), "unit"), rows, note)

    def _lead_chart(self, case: Case, at: Overrides) -> Figure:
        """The trace of helix slope and crowning with its tolerances, dashed as described."""
        curves, inputs = case.response.misalignment.curves, case.response.inputs
        position = values(curves.position_mm)
        wanted = Lead(*(float(at[path] or 0.0) for path in (SLOPE, CROWNING)))
        before = Lead(*(float(value_at(inputs, path) or 0.0) for path in (SLOPE, CROWNING)))
        tolerance = Lead(*(self.input(path).declared.tolerance or 0.0 for path in (SLOPE, CROWNING)))
        return lead_chart(values(curves.z_mm), position / position[-1], wanted, before, tolerance, _ends(case))


def _ends(case: Case) -> tuple[str, str]:
    """What the end of the face that meshes first and the one that leaves the mesh last are called."""
    first, *_, last = case.response.misalignment.curves.z_mm
    drive = case.request.pinion_shaft.torque_position_mm
    if drive is None:
        return f"end at Z = {shown(first)} mm", f"end at Z = {shown(last)} mm"
    sides = ("drive end", "free end") if abs(first - drive) < abs(last - drive) else ("free end", "drive end")
    return f"{sides[0]} (Z = {shown(first)} mm)", f"{sides[1]} (Z = {shown(last)} mm)"


def _numbers(case: Case, end: Line, at: Overrides) -> Table:
    """Which helix slope and crowning stand on the pages of this unit, and what each is."""
    found, inputs = case.response.misalignment, case.response.inputs
    estimate = "first estimate: inputs as described, load spread evenly over the face"
    entries = (
        ("as described", value_at(inputs, SLOPE), value_at(inputs, CROWNING)),
        (estimate, found.recommended_helix_slope_um, found.recommended_lead_crowning_um),
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
    """The gap over the face as ground, dashed as described, both without the corner's changes."""
    try:
        own, given = (GAP.figure(each.request, each.response) for each in (ground, case))
    except NoFigure:
        return {}
    return {GAP.name: compared(own, given, "as described")}


PAGE = DesignPage
