"""Design: the flank correction whose worst corner is best, beside that of the case."""

from dataclasses import dataclass
from math import inf
from typing import Any

from app.figures.comparison import compared
from app.figures.data import Axis, Figure, NoFigure
from app.figures.models.drive_train import GAP
from app.figures.studies import Tried, search
from app.pages import study_links
from app.pages.cases import Case
from app.pages.query import LOWER, TRIALS, UPPER, body_of, number_of, text_of
from app.pages.studies.corners import OUTPUT, corner_table, load_figure, worst_end
from app.pages.studies.declaration import (
    Cell,
    Controls,
    Form,
    Lead,
    PageStudy,
    Result,
    StudyPage,
    Table,
    address_at,
    case_at,
)
from app.pages.typesetting import shown
from app.pages.views import Asked
from app.schema.fields import Leaf
from app.studies.design import design_study
from app.studies.drive_train import usual_corners
from app.studies.fields import scalar_at, value_at
from app.studies.stream import Line
from app.studies.study import checked_base

EVALUATIONS = 40
LEFT_ALONE = ("radial_clearance_um", "thrust_fraction")  # of the usual corners, for they say least


@dataclass(frozen=True, slots=True)
class Ground:
    """What may be ground: fields of one value, and the range searched when none is given."""

    label: str
    paths: tuple[str, ...]
    low: float
    high: float
    unit: str = "µm"


GROUND = (
    Ground("helix slope", ("modifications.helix_slope_um",), -100.0, 100.0),
    Ground("crowning", ("modifications.lead_crowning_um",), 0.0, 20.0),
    Ground("relief at tip and root", ("modifications.tip_relief_um", "modifications.root_relief_um"), 0.0, 30.0),
)


def _body(asked: Asked, output: Leaf) -> dict[str, Any]:
    """The ranges as typed or usual, at the usual corners of heat and couplings."""
    calculation, said = asked.calculation, asked.views
    request = body_of(calculation.request, asked.pairs)
    axes = usual_corners(checked_base(calculation, request, {}))
    chosen = [axis for axis in axes if not str(axis.paths[0]).endswith(LEFT_ALONE)]
    return {
        "request": request,
        "variables": [
            {
                "path": list(each.paths),
                "min": number_of(said.get(f"{LOWER}{place}", text_of(each.low))),
                "max": number_of(said.get(f"{UPPER}{place}", text_of(each.high))),
            }
            for place, each in enumerate(GROUND)
        ],
        "corners": [axis.model_dump(exclude_none=True) for axis in chosen] or None,
        "objective": output.path,
        "direction": "maximise" if worst_end(output) == "min" else "minimise",
        "evaluations": number_of(said.get(TRIALS, str(EVALUATIONS))),
    }


def _controls(form: Form) -> tuple[Controls, ...]:
    """Ranges of what may be ground, and how many corrections are tried."""
    fields = [form.field(TRIALS, "corrections tried", EVALUATIONS)]
    for place, each in enumerate(GROUND):
        fields.append(form.field(f"{LOWER}{place}", f"{each.label}, from", each.low, each.unit))
        fields.append(form.field(f"{UPPER}{place}", f"{each.label}, to", each.high, each.unit))
    return (Controls("Study", fields=tuple(fields)),)


def _result(study: PageStudy, lines: list[Line]) -> Result:
    """The search, the load before and after at the worst corner, the gap that is left, all in numbers."""
    end, output, asked = lines[-1], study.output, study.asked
    trials = [line for line in lines if line["type"] == "trial"]
    best, start = end["best"], trials[0]["worst_corner"]
    outputs = [output.path]
    figures = {
        "search": search(Axis(output.title, output.unit), _tried(trials), greatest=worst_end(output) == "min"),
        **load_figure(
            case_at(asked, {**best, **end["worst_corner"]}, outputs),
            case_at(asked, start, outputs),
            "ground so",
            "each at its worst corner, dashed as described: ",
        ),
    }
    case, ground = case_at(asked, {}, outputs), case_at(asked, best, outputs)
    figures |= _gap(ground, case)
    remarks = [f"{end['unsolved']} of the corrections had a corner without solution."] if end["unsolved"] else []
    return Result(
        f"{end['evaluations']} corrections at {lines[0]['corners']} corners in {shown(end['elapsed_s'], 2)} s",
        figures,
        (_grinding(study, end, case), corner_table("Where it is worst then", asked, ground, end["worst_corner"])),
        tuple(remarks),
        (
            Lead("Open the unit ground so", address_at(asked, best)),
            Lead("Its report", address_at(asked, best, "/report")),
            Lead("Its worst corners", address_at(asked, best, f"/{study_links.CORNERS.name}")),
        ),
    )


def _tried(trials: list[Line]) -> list[Tried]:
    return [
        Tried(inf if line["objective"] is None else line["objective"], line["objective"] is not None) for line in trials
    ]


def _gap(ground: Case, case: Case) -> dict[str, Figure]:
    """The gap over the face as ground, dashed as described, both without the corner's changes."""
    try:
        own, given = (GAP.figure(each.request, each.response) for each in (ground, case))
    except NoFigure:
        return {}
    return {GAP.name: compared(own, given, "as described")}


def _grinding(study: PageStudy, end: Line, case: Case) -> Table:
    """What to grind instead of what, and what it brings."""
    request = study.asked.calculation.request
    output, best = study.output, end["best"]
    rows = [
        (
            Cell(leaf.title),
            Cell(shown(_given(case, leaf.path)), right=True),
            Cell(shown(best[leaf.path], 3), right=True),
            Cell(leaf.unit or ""),
        )
        for leaf in (scalar_at(request, path, "", "unknown_path") for path in best)
    ]
    judged = (
        Cell(f"{output.title}, at the worst corner of each"),
        Cell(shown(end["objective_start"]), right=True),
        Cell(shown(end["objective_best"]), right=True),
        Cell(output.unit or ""),
    )
    head = (Cell("grind"), Cell("as described", right=True), Cell("proposed", right=True), Cell("unit"))
    return Table("What to grind", head, (*rows, judged))


def _given(case: Case, path: str) -> float | None:
    value: float | None = value_at(case.response.inputs, path)
    return value


DESIGN = StudyPage(
    link=study_links.DESIGN,
    question="what to grind?",
    about="A search for helix slope, crowning and relief, each judged at its worst corner of wall response, friction "
    "and direction of the couplings' offset. It starts from the correction of the case.",
    figures=("search", "face-load", GAP.name),
    body=_body,
    plan=design_study,
    result=_result,
    output=OUTPUT,
    controls=_controls,
)
