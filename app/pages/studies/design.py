"""Design: the flank correction whose worst corner is best, as a sheet for the grinder, and how it was found."""

from typing import Any

from app.figures.comparison import compared
from app.figures.data import Figure, NoFigure, values
from app.figures.models.drive_train import GAP, LOAD_ALONE
from app.figures.studies import Lead, lead_chart, search
from app.figures.units import axis_of
from app.pages import study_links
from app.pages.cases import Case
from app.pages.query import LOWER, TRIALS, UPPER
from app.pages.studies.corners import UnitPage, load_figure
from app.pages.studies.page import Controls, Link, Number, Result, Table
from app.pages.typesetting import shown
from app.studies.design import Design
from app.studies.engine import Line
from app.studies.fields import value_at
from app.studies.requests import Overrides

EVALUATIONS = 40  # offered at first, chosen
STEP_UM = 0.5  # to which a correction is rounded
SLOPE, CROWNING = "modifications.helix_slope_um", "modifications.lead_crowning_um"
TIP, ROOT = "modifications.tip_relief_um", "modifications.root_relief_um"


# What may be ground: label, fields of one value, and the range searched when none is given [um]. The ranges are chosen:
# wider than what is ground of teeth of a few millimetres of module, and the user may change them.
GROUND = (
    ("helix slope", (SLOPE,), -100.0, 100.0),
    ("crowning", (CROWNING,), 0.0, 20.0),
    ("relief at tip and root", (TIP, ROOT), 0.0, 30.0),
)


class DesignPage(UnitPage):
    """The flank correction whose worst corner is best."""

    link = study_links.DESIGN
    question = "what to grind?"
    about = (
        "A search for helix slope, crowning and relief, each judged at its worst corner of the uncertain inputs. It "
        "starts from the correction of the case."
    )
    figures = ("lead", LOAD_ALONE.name, GAP.name, "search")
    grows = True
    left_alone = ("pinion clearance", "wheel clearance", "thrust fraction")  # they change the result least
    plan = Design

    def body(self) -> dict[str, Any]:
        """The ranges as typed or usual, at the corners as typed or the usual ones of heat and couplings."""
        output = self.output
        variables = [
            {
                "path": list(paths),
                "min": self.number(f"{LOWER}{place}", low),
                "max": self.number(f"{UPPER}{place}", high),
                "step": STEP_UM,
            }
            for place, (_, paths, low, high) in enumerate(GROUND)
        ]
        return {
            "request": self.asked.body,
            "variables": variables,
            "corners": list(self.ranges().values()) or None,
            "objective": output.path,
            "direction": "maximise" if output.view.greatest_is_best else "minimise",
            "evaluations": self.number(TRIALS, EVALUATIONS),
        }

    def places(self) -> dict[str, str]:
        """The controls of the ranges, of the uncertain inputs, of the number of trials, and of the output."""
        lower = {f"variables.{place}": f"{LOWER}{place}" for place in range(len(GROUND))}
        upper = {f"variables.{place}.max": f"{UPPER}{place}" for place in range(len(GROUND))}
        return {**super().places(), **lower, **upper, "evaluations": TRIALS, "objective": "show"}

    def controls(self) -> tuple[Controls, ...]:
        """Ranges of what may be ground, how many corrections are tried, and the uncertain inputs."""
        fields = [self.field(TRIALS, "corrections tried", EVALUATIONS)]
        for place, (label, _, low, high) in enumerate(GROUND):
            fields.append(self.field(f"{LOWER}{place}", f"{label}, from", low, "µm"))
            fields.append(self.field(f"{UPPER}{place}", f"{label}, to", high, "µm"))
        return Controls("Search", fields=tuple(fields)), *super().controls()

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
                Link("Its worst corners", self.address(at, f"/{study_links.CORNERS.name}")),
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
