"""The page of the design study: the best flank correction as a sheet for the grinder, and how exactly to grind it."""

from dataclasses import replace
from functools import cached_property
from typing import Any, NamedTuple

from app.figures.comparison import compared
from app.figures.data import Axis, Figure, NoFigure, values
from app.figures.spectrum import chance_text
from app.figures.studies import Lead, lead_chart, search
from app.figures.units import axis_of
from app.figures.wording import percent
from app.models.drive_train.figures import GAP, LOAD_ALONE
from app.models.sections.gears import QUALITY_CLASS, of_class
from app.pages.cases import REFUSED, SolvedCase
from app.pages.pair_path import WITH_PAIR
from app.pages.studies.controls import Control
from app.pages.studies.page import OUTPUT, Controls, Link, Number, Result, Table
from app.pages.studies.price import (
    NO_PRICE,
    exact_enough,
    price_figures,
    price_remarks,
    price_tables,
    price_verdict,
    time_left,
)
from app.pages.studies.unit import UnitPage, load_figure, typed_axis
from app.pages.study_kinds import CORNERS, DESIGN, control_of
from app.pages.typesetting import shown
from app.schema.fields import leaf_at, value_at
from app.studies.kinds.design import SECOND_HELIX, Design
from app.studies.machines import PAIR
from app.studies.points import BaseRequest
from app.studies.price import damages
from app.studies.requests import Overrides
from app.studies.runner import Line
from app.studies.tolerances import class_tolerances

PAIRS = 4  # of machines in a sample, default of the page; chosen so that it answers in a minute or two
SAMPLES = 4  # independent samples of machines; the scatter of their means gives the error of a probability
EVALUATIONS = 24  # default of the largest number of evaluations on the page; chosen
STEP_UM = 0.5  # the page rounds the best correction to multiples of this step
SLOPE, CROWNING = "modifications.helix_slope_um", "modifications.lead_crowning_um"
TIP, ROOT = "modifications.tip_relief_um", "modifications.root_relief_um"
SLOPE_2, CROWNING_2 = "modifications.second_helix.helix_slope_um", "modifications.second_helix.lead_crowning_um"
HELICES = ((SLOPE, CROWNING), (SLOPE_2, CROWNING_2))  # fields of the correction of each helix, in the order of Z
# The corrections that may be ground. Each entry has a label, the fields that get the value of the correction, and the
# ends of the default range of the search [um]. The ranges are chosen. They are wider than the corrections that are
# usual for modules of a few millimetres. The user may change the ranges.
GROUND = (
    ("helix slope", (SLOPE,), -100.0, 100.0),
    ("crowning", (CROWNING,), 0.0, 20.0),
    ("relief at tip and root", (TIP, ROOT), 0.0, 30.0),
)
OF_SECOND_HELIX = (
    ("helix slope, helix 2", (SLOPE_2,), -100.0, 100.0),
    ("crowning, helix 2", (CROWNING_2,), 0.0, 20.0),
)
TRIALS = Control("trials", "evaluations", EVALUATIONS, label="corrections tried")
JUDGED = Control(
    "judged",
    "judged_by",
    "worst_corner",
    str,
    label="judged by",
    options=(("", "best worst corner"), ("probability", "least probability of damage")),
)
DRAWN = Control(
    "drawn",
    "tolerances.count",
    PAIRS,
    label="machines drawn",
    options=tuple(("" if count == PAIRS else str(count), str(PAIR * SAMPLES * count)) for count in (PAIRS, 8, 16, 32)),
)


class DesignPage(UnitPage):
    """The page that shows the flank correction with the best result at the worst corner."""

    link = DESIGN
    question = "what to grind, and how exactly?"
    about = (
        "The search varies helix slope, crowning and relief; of double-helical gears, slope and crowning of each "
        "helix. It starts from the correction of the case, and judges each one at its worst corner of the uncertain "
        "inputs, or by the probability of damage. Machines are then drawn for the correction found: uncertain inputs, "
        "load, what the models do not know well, and the flanks by quality class."
    )
    figures = ("price", "dominating", "lead", LOAD_ALONE.name, GAP.name, "search")
    grows = True
    plan = Design

    @cached_property
    def is_double_helical(self) -> bool:
        """Whether the case has two helices, each with a correction of its own."""
        return any(name == "gears.gap_width_mm" and text for name, text in self.asked.pairs)

    @property
    def ground(self) -> tuple[tuple[str, tuple[str, ...], float, float], ...]:
        """The corrections that may be ground on the gears of the case."""
        return (*GROUND, *OF_SECOND_HELIX) if self.is_double_helical else GROUND

    @property
    def ends(self) -> tuple[Control, ...]:
        """Two controls per correction, for the ends of the range that is searched."""
        return tuple(
            control
            for place, (label, _, low, high) in enumerate(self.ground)
            for control in (
                Control(f"low.{place}", f"variables.{place}.min", low, label=f"{label}, from", unit="µm"),
                Control(f"high.{place}", f"variables.{place}.max", high, label=f"{label}, to", unit="µm"),
            )
        )

    @property
    def left_alone(self) -> tuple[str, ...]:
        """The uncertain inputs with least influence, so that a search takes minutes.

        Of two helices, the thrust decides which one carries more; friction scales it, the wall acts on both alike.
        """
        weak = ("friction", "wall response") if self.is_double_helical else ("thrust fraction",)
        return ("pinion clearance", "wheel clearance", *weak)

    def body(self) -> dict[str, Any]:
        """Return the body of the study's request."""
        output, given = self.output, self.given()
        for (_, paths, *_), variable in zip(self.ground, given["variables"], strict=True):
            variable |= {"path": list(paths), "step": STEP_UM}
        drawn = {"replicates": SAMPLES, **given.pop("tolerances"), **self._uncertain()}
        return {
            "request": self.asked.body,
            **given,
            "objective": output.path,
            "direction": "maximise" if output.view.greatest_is_best else "minimise",
            "tolerances": drawn if self.has_limit or self.by_probability else None,
        }

    @property
    def by_probability(self) -> bool:
        """Whether corrections are judged by the probability of damage."""
        return self.views.get(JUDGED.name) == "probability"

    @cached_property
    def has_limit(self) -> bool:
        """Whether the case states a limit of scuffing or micropitting."""
        try:
            damages(BaseRequest(self.calculation, self.asked.body).checked({}))
        except REFUSED:
            return False
        return True

    def _uncertain(self) -> dict[str, Any]:
        """Return what differs between machines where the user typed values of uncertain inputs; else nothing."""
        typed = {quantity: self.views.get(control_of(quantity)) for quantity in self.uncertain}
        if not any(typed.values()):
            return {}
        axes = [
            typed_axis(axis, typed[quantity] or "") if typed[quantity] else {"path": axis.path, "values": axis.values}
            for quantity, axis in self.uncertain.items()
        ]
        return {"uncertain": axes}

    def declared(self) -> tuple[Control, ...]:
        """Return the controls for the number of trials, the ranges of the corrections and the uncertain inputs."""
        whole = (Control(f"low.{place}", f"variables.{place}", sets=False) for place in range(len(self.ground)))
        objective = Control(OUTPUT.name, "objective", sets=False)
        drawn = Control(DRAWN.name, "tolerances", sets=False)
        return (TRIALS, JUDGED, DRAWN, *self.ends, *whole, objective, drawn, *super().declared())

    def controls(self) -> tuple[Controls, ...]:
        """Return two groups of form fields."""
        fields = tuple(map(self.field_of, (JUDGED, TRIALS, DRAWN, *self.ends)))
        return Controls("Search", fields=fields), *super().controls()

    def result(self, lines: list[Line]) -> Result:
        """Return the sheet for the grinder, the price of the tolerance, and figures of lead, load, gap and search.

        While the search runs, return only the best correction so far, the classes so far and the figure of the search.
        """
        trials = [line for line in lines if line["type"] == "trial"]
        solved_trials = [line for line in trials if line["objective"] is not None]
        if not solved_trials:
            return Result("")
        end, greatest = lines[-1], self.output.view.greatest_is_best and not self.by_probability
        scale = 100.0 if self.by_probability else 1.0
        objectives = [None if line["objective"] is None else scale * line["objective"] for line in trials]
        axis = Axis("probability of damage", "%") if self.by_probability else axis_of(self.output)
        figure = {"search": search(axis, objectives, greatest=greatest, where=self._where)}
        if end["type"] != "end":
            best = (max if greatest else min)(solved_trials, key=lambda line: line["objective"])
            lead = Link("Open the unit ground so", self.address(best["at"]))
            so_far = (self._so_far(solved_trials[0], best),)
            left = time_left(self.study, trials, [line for line in lines if line["type"] == "price"])
            return Result("", figure, first=so_far, leads=(lead,), answer=left)
        wanted = end["rounded"]
        if wanted["objective"] is None:
            wanted = {"at": end["best"], "objective": end["objective_best"], "worst_corner": end["worst_corner"]}
        at, corner, price = wanted["at"], wanted["worst_corner"], end.get("price")
        case, ground = self.solved({}), self.solved(at)
        at_worst, as_described = self.solved({**at, **corner}), self.solved(trials[0]["worst_corner"])
        finding = "each at its worst corner, dashed as described: "
        figures = {
            **({} if price is None else price_figures(price)),
            "lead": self._lead_chart(case, at, {} if price is None else exact_enough(price)),
            **load_figure(at_worst, as_described, "ground so", finding),
            **_gap(ground, case),
            **figure,
        }
        unsolved = end["unsolved"]
        remarks = [f"{unsolved} of the corrections have a corner without solution."] if unsolved else []
        remarks += [NO_PRICE] if price is None else price_remarks(price)
        title = "The drawn machine that comes closest to damage" if self.by_probability else "The worst corner"
        return Result(
            f"{end['evaluations']} corrections {self._judged(lines[0])} in {shown(end['elapsed_s'], 2)} s",
            figures,
            (
                *(() if price is None else price_tables(price)[1:]),
                _numbers(case, end, at),
                self.corner_table(f"{title} with this correction", ground, corner),
            ),
            tuple(remarks),
            (
                Link("Open the unit ground so", self.address(at)),
                Link("Its report", self.address(at, "/report")),
                Link("One report of all steps", self.address(at | self._exactly(price), "/report", extent=WITH_PAIR)),
                Link("Its worst corners", self.address(at, f"/{CORNERS.name}")),
            ),
            first=(
                grinding_sheet(case, at, price),
                *(() if price is None else price_tables(price)[:1]),
                self._before_and_after(end, wanted, case, ground),
            ),
            answer="" if price is None else price_verdict(price),
        )

    def _exactly(self, price: Line | None) -> Overrides:
        """Return the class to which the gears of a report are ground, unless the case has one."""
        own = value_at(self.asked.body, QUALITY_CLASS)
        return {} if price is None or own or not price["coarsest_class"] else of_class(price["coarsest_class"])

    @property
    def _where(self) -> str:
        return "over the drawn machines" if self.by_probability else "at the worst corner"

    def _judged(self, header: Line) -> str:
        count = header["corners"]
        return f"by {count} machines each" if self.by_probability else f"at {count} corners"

    def _objective(self, value: float | None) -> str:
        """Return an objective as text."""
        return percent(value) if self.by_probability and value is not None else shown(value)

    @property
    def _objective_unit(self) -> str:
        return "" if self.by_probability else self.output.unit or ""

    def _so_far(self, start: Line, best: Line) -> Table:
        """Return the table that the page shows while the search runs: the best correction so far."""
        rows = []
        for path, value in best["at"].items():
            leaf = self.input(path)
            rows.append((leaf.title, shown(start["at"][path], 4), shown(value, 4), leaf.unit or ""))
        what = "probability of damage" if self.by_probability else self.output.title
        values = (self._objective(start["objective"]), self._objective(best["objective"]))
        rows.append((f"{what}, {self._where}", *values, self._objective_unit))
        return Table("Best so far", ("correction", Number("as described"), Number("best so far"), "unit"), rows)

    def _before_and_after(self, end: Line, wanted: Line, case: SolvedCase, ground: SolvedCase) -> Table:
        """Return a table that compares the output before and after the correction."""
        output = self.output
        before, after = (value_at(unit_case.response, output.path) for unit_case in (case, ground))
        unit, note, price = output.unit or "", "", end.get("price")
        values = (self._objective(end["objective_start"]), self._objective(wanted["objective"]))
        what = "probability of damage, by the machines of the search" if self.by_probability else output.title
        where = "" if self.by_probability else ", at the worst corner of each"
        rows = [
            (f"{what}{where}", *values, self._objective_unit),
            (f"{output.title}, with the inputs as described", shown(before), shown(after), unit),
        ]
        if price is not None:
            own = next(row for row in price["classes"] if row["quality_class"] == price["reference_class"])
            chances = (chance_text(price["as_described"]), chance_text(own))
            rows.append((f"probability of damage, flanks of class {price['reference_class']}", *chances, ""))
            rows.append(("probability of damage, only the limits scatter", "–", chance_text(price["nominal"]), ""))
        if None not in {before, after} and (after < before if output.view.greatest_is_best else after > before):
            note = (
                "With the inputs as described the result is worse than before. The reason is that the correction is "
                f"chosen {self._where}; a flank that is right there is not quite right elsewhere."
            )
        return Table("What it brings", ("number", Number("as described"), Number("ground so"), "unit"), rows, note)

    def _lead_chart(self, case: SolvedCase, at: Overrides, widths: Overrides) -> Figure:
        """Return the figure of the lead, which is the sum of helix slope and crowning.

        The solid line is the lead to grind, with its tolerance band. The dashed line is the lead as entered.
        """
        charts = []
        for each in _faces(case):
            curves, paths = each.misalignment.curves, (each.slope, each.crowning)
            position = values(curves.position_mm)
            wanted = Lead(*(float(at[path] or 0.0) for path in paths))
            before = Lead(*(_described(case, path) for path in paths))
            usual = {path: self.input(path).declared.tolerance or 0.0 for path in paths}
            tolerance = Lead(*(float(widths.get(path) or usual[path]) for path in paths))
            chart = lead_chart(values(curves.z_mm), position / position[-1], wanted, before, tolerance, each.ends)
            charts.append(replace(chart, panels=[replace(panel, title=each.name or None) for panel in chart.panels]))
        return replace(charts[0], panels=[panel for chart in charts for panel in chart.panels])


def grinding_sheet(case: SolvedCase, at: Overrides | None = None, price: Line | None = None) -> Table:
    """Return the sheet for the grinder: gear, place on the flank, amount and tolerance of each correction.

    `at` are the corrections to grind, beside those of the case; None: the corrections of the case itself. With the
    price of a tolerance, that of a slope is of the coarsest class that is exact enough; without it, of the gears' own.
    """
    widths = class_tolerances(case.request) if price is None else exact_enough(price)
    quality = value_at(case.request, QUALITY_CLASS) if price is None else price["coarsest_class"]
    inputs, faces, request = case.response.inputs, _faces(case), type(case.request)
    tip, wheel_tip = (
        f"tip relief, {shown(length)} mm along the line of action" if length is not None else "tip relief"
        for length in (value_at(inputs, path.replace("_um", "_length_mm")) for path in (TIP, ROOT))
    )
    wanted = {path: _described(case, path) if at is None else float(at[path] or 0.0) for path in _corrections(faces)}
    entries = [entry for each in faces for entry in _lead_entries(each, wanted[each.slope])]
    both = ", both helices" if len(faces) > 1 else ""
    entries.append((TIP, f"pinion{both}", tip, "tip deeper than the involute"))
    entries.append((ROOT, f"wheel{both}", wheel_tip, "tip deeper than the involute"))
    rows = []
    for path, gear, feature, place in entries:
        leaf, described, amount = leaf_at(request, path), _described(case, path), wanted[path]
        assert leaf is not None
        if path in {SLOPE, SLOPE_2}:  # for the slope, the column `where` shows the sign
            described, amount = -described if amount < 0.0 else described, abs(amount)
        before = () if at is None else (shown(described),)
        tolerance = f"± {shown(widths.get(path, leaf.declared.tolerance), 3)}"
        rows.append((gear, feature, place, *before, shown(amount, 4), tolerance, leaf.unit or ""))
    numbered = map(Number, ("grind", "tolerance") if at is None else ("as described", "grind", "tolerance"))
    by_class = f"; that of a slope is what both gears together may have in quality class {quality}" if widths else ""
    note = (
        'Only the working flanks are corrected. "Deeper" means that more material is removed. '
        + (f"Corrections are multiples of {STEP_UM:g} µm; the" if at else "The")
        + f" tolerances are usual for these corrections{by_class}. Helix slope and crowning are the sums for both "
        "gears and are put on the pinion. Tip relief of the wheel replaces root relief of the pinion."
    )
    return Table("What to grind", ("gear", "correction", "where", *numbered, "unit"), rows, note)


def _corrections(faces: list["_Face"]) -> list[str]:
    """Return the fields of all corrections."""
    return [*(path for each in faces for path in (each.slope, each.crowning)), TIP, ROOT]


class _Face(NamedTuple):
    """A face with a correction of its own: the only one, or one of two helices."""

    name: str  # empty if it is the only one
    slope: str  # fields of its correction
    crowning: str
    misalignment: Any
    ends: tuple[str, str]  # names of its ends; that which meshes first comes first


def _faces(case: SolvedCase) -> list[_Face]:
    """Return the faces of the case in the order of Z."""
    helices = case.response.helices
    if helices is None:
        return [_Face("", SLOPE, CROWNING, case.response.misalignment, _ends(case))]
    found = []
    for place, (helix, paths) in enumerate(zip(helices, HELICES, strict=True)):
        first, *_, last = helix.misalignment.curves.z_mm
        outer = min(first, last) if place == 0 else max(first, last)
        one, other = (
            f"{'outer end' if end == outer else 'end at the gap'} (Z = {shown(end)} mm)" for end in (first, last)
        )
        found.append(_Face(f"helix {place + 1}", *paths, helix.misalignment, (one, other)))
    return found


def _described(case: SolvedCase, path: str) -> float:
    """Return a correction of the case [um]; the second helix is as the first where nothing else is said."""
    inputs = case.response.inputs
    own = value_at(inputs, path)
    return float((value_at(inputs, path.replace(SECOND_HELIX, ".")) if own is None else own) or 0.0)


def _lead_entries(face: _Face, slope: float) -> list[tuple[str, str, str, str]]:
    """Return field, gear, correction and place of the two corrections of a face over its width."""
    deep, high = face.ends if slope < 0.0 else face.ends[::-1]
    gear = f"pinion, {face.name}" if face.name else "pinion"
    return [
        (face.slope, gear, "helix slope, over the face width", f"{deep} deeper than the {high}, straight between"),
        (face.crowning, gear, "helix crowning", "both ends deeper than the middle of the face"),
    ]


def _ends(case: SolvedCase) -> tuple[str, str]:
    """Return the names of both ends of the face. The end that meshes first comes first."""
    first, *_, last = case.response.misalignment.curves.z_mm
    drive = case.request.pinion_shaft.torque_position_mm
    if drive is None:
        return f"end at Z = {shown(first)} mm", f"end at Z = {shown(last)} mm"
    sides = ("drive end", "free end") if abs(first - drive) < abs(last - drive) else ("free end", "drive end")
    return f"{sides[0]} (Z = {shown(first)} mm)", f"{sides[1]} (Z = {shown(last)} mm)"


def _numbers(case: SolvedCase, end: Line, at: Overrides) -> Table:
    """Return a table that explains why the pages of a gear unit show different values of helix slope and crowning.

    Each row states the helix slope and the crowning of each helix, and the source of these values.
    """
    faces = _faces(case)
    paths = [path for each in faces for path in (each.slope, each.crowning)]
    estimates = [
        estimate
        for each in faces
        for estimate in (each.misalignment.recommended_helix_slope_um, each.misalignment.recommended_lead_crowning_um)
    ]
    entries = (
        ("as described", [_described(case, path) for path in paths]),
        ("first estimate: inputs as described, load spread evenly over the face", estimates),
        ("best at the worst corner, as the search found it", [end["best"][path] for path in paths]),
        (f"to grind: the best in multiples of {STEP_UM:g} µm", [at[path] for path in paths]),
    )
    heads = [
        Number(", ".join(filter(None, (what, each.name, "µm"))))
        for each in faces
        for what in ("helix slope", "helix crowning")
    ]
    return Table(
        "Which number is which",
        ("number", *heads),
        tuple((name, *(shown(amount, 4) for amount in amounts)) for name, amounts in entries),
        "A positive helix slope removes material at the end of the face that leaves the mesh last.",
    )


def _gap(ground: SolvedCase, case: SolvedCase) -> dict[str, Figure]:
    """Return the figure of the gap between the flanks over the face."""
    try:
        own, given = (GAP.figure(unit_case.request, unit_case.response) for unit_case in (ground, case))
    except NoFigure:
        return {}
    return {GAP.name: compared(own, given, "as described")}
