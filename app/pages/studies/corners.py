"""Corners: an output over every combination of the uncertain inputs of a unit, and the load at the worst one."""

from dataclasses import replace
from typing import Any

from app.figures.comparison import compared
from app.figures.data import Figure, NoFigure
from app.figures.models.drive_train import LOAD_ALONE
from app.figures.studies import Uncertain, corners
from app.figures.units import axis_of
from app.figures.wording import listed, number
from app.pages import study_links
from app.pages.cases import Case
from app.pages.query import CORNER, UNCERTAIN, body_of, number_of, text_of
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
from app.pages.views import REFUSED, Asked
from app.schema.fields import Leaf, headlines
from app.studies.base_request import COLD, BaseRequest, needs_film
from app.studies.engine import Line
from app.studies.fields import scalar_at, value_at
from app.studies.point_sets import usual_corners
from app.studies.requests import DRIVE_TRAIN, USUAL_RANGES, Overrides
from app.studies.sweep import corners_study

OUTPUT = "safety.blok_flank"


def ranges_of(asked: Asked, left_alone: tuple[str, ...] = ()) -> dict[str, dict[str, Any]]:
    """The values of the uncertain inputs as typed, else the usual ones, by the names of their controls.

    Those of `left_alone` are as in the case where nothing is typed. A case that is refused has none.
    """
    calculation = asked.calculation
    try:
        usual = usual_corners(BaseRequest(calculation, body_of(calculation.request, asked.pairs)).checked({}))
    except REFUSED:
        return {}
    found = {}
    for quantity, axis in usual.items():
        name = control_of(quantity)
        if text := asked.views.get(name):
            rows = [[number_of(each) for each in row.split()] for row in text.split(";")]
            found[name] = {"path": axis.path, "values": [row[0] if len(row) == 1 else row for row in rows]}
        elif quantity not in left_alone:
            found[name] = axis.model_dump(exclude_none=True)
    return found


def control_of(quantity: str) -> str:
    """The name of the control of an uncertain input."""
    return f"{CORNER}{quantity.replace(' ', '_')}"


def range_controls(form: Form, left_alone: tuple[str, ...] = ()) -> Controls:
    """A field for the values of each uncertain input."""
    bare = replace(form.asked, views={})
    usual, ranges = ranges_of(bare), ranges_of(bare, left_alone)
    request = form.asked.calculation.request
    fields = []
    for quantity in UNCERTAIN:
        name = control_of(quantity)
        if axis := usual.get(name):
            path = axis["path"] if isinstance(axis["path"], str) else axis["path"][0]
            unit = scalar_at(request, path, "", "unknown_path").unit or ""
            text = _text(axis["values"]) if name in ranges else "as in the case"
            fields.append(form.field(name, quantity, text, unit))
    about = "Values with semicolons between; blanks between inputs that move together."
    return Controls("Uncertain inputs", fields=tuple(fields), about=about)


def _text(rows: list[Any]) -> str:
    """Values as they are typed: choices with semicolons between, blanks between inputs that move together."""
    return "; ".join(" ".join(map(text_of, row)) if isinstance(row, list) else text_of(row) for row in rows)


def _controls(form: Form) -> tuple[Controls, ...]:
    return (range_controls(form),)


def _body(asked: Asked, output: Leaf) -> dict[str, Any]:
    """The corners as typed or usual, and beside the output what decides and costs no film."""
    paths = [leaf.path for leaf in headlines(asked.calculation.response)]
    deciding = [path for path in paths if not (needs_film(DRIVE_TRAIN, path) or path.startswith(COLD))]
    return {
        "request": body_of(asked.calculation.request, asked.pairs),
        "ranges": list(ranges_of(asked).values()) or None,
        "outputs": list(dict.fromkeys([output.path, *deciding])),
    }


def _result(study: PageStudy, lines: list[Line]) -> Result:
    """What each uncertainty does, the load at the worst corner beside that of the case, both in numbers."""
    header, end = lines[0], lines[-1]
    extremes = {line["output"]: line for line in lines if line["type"] == "extremes"}
    progress = f"{end['points']} corners in {shown(end['elapsed_s'], 2)} s"
    remarks = [warning["message"] for warning in end["warnings"]]
    output = study.output
    if output.path not in extremes:
        remarks.append(f"No corner has a {output.title}; choose another output.")
        return Result(progress, remarks=tuple(remarks))
    worst = extremes[output.path][worst_end(output)]["at"]
    outputs = [each["path"] for each in header["outputs"]]
    case, other = case_at(study.asked, {}, outputs), case_at(study.asked, worst, outputs)
    found = {"corners": corners(axis_of(output), _uncertain(study, lines, worst), value_at(case.response, output.path))}
    found |= load_figure(other, case, "worst corner", "worst corner and, dashed, as described: ")
    return Result(
        progress,
        found,
        (_extremes(study, header, extremes, case), corner_table("The worst corner", study.asked, case, worst)),
        tuple(remarks),
        (
            Lead("Open the worst corner", address_at(study.asked, worst)),
            Lead("Its report", address_at(study.asked, worst, "/report")),
            Lead("What to grind", study.asked.links.study(study_links.DESIGN.name)),
        ),
    )


def worst_end(output: Leaf) -> str:
    """Which of its ends is the bad one: the lower where it has to stay above something, else the upper."""
    return "min" if output.view.bound == "lower" else "max"


def load_figure(case: Case, reference: Case, name: str, finding: str) -> dict[str, Figure]:
    """Load along the face at a corner (solid) and for the case as entered (dashed); None where there is no load."""
    try:
        own, given = (LOAD_ALONE.figure(each.request, each.response) for each in (case, reference))
    except NoFigure:
        return {}
    (panel,) = compared(own, given, "as described").panels
    line, *dashed = panel.lines
    panel = replace(panel, lines=(replace(line, title=name), *(replace(each, title="as described") for each in dashed)))
    return {LOAD_ALONE.name: replace(own, finding=f"{finding}{own.finding}, dashed {given.finding}", panels=(panel,))}


def corner_table(title: str, asked: Asked, case: Case, corner: Overrides) -> Table:
    """What a corner changes in the case."""
    leaves = [scalar_at(asked.calculation.request, path, "", "unknown_path") for path in corner]
    inputs = case.response.inputs
    rows = tuple(
        (
            Cell(named(leaf)),
            Cell(shown(value_at(inputs, leaf.path)), right=True),
            Cell(shown(corner[leaf.path]), right=True),
            Cell(leaf.unit or ""),
        )
        for leaf in leaves
    )
    head = (Cell("input"), Cell("as described", right=True), Cell("there", right=True), Cell("unit"))
    return Table(title, head, rows)


def named(leaf: Leaf) -> str:
    """Title of an input; which one it is where there are several."""
    places = [str(int(part) + 1) for part in leaf.path.split(".") if part.isdecimal()]
    return " ".join([leaf.title, *([".".join(places)] if places else [])])


def _uncertain(study: PageStudy, lines: list[Line], worst: Overrides) -> list[Uncertain]:
    """Of each choice of each axis the worst that the output is with it."""
    axes, points = lines[0]["axes"], [line for line in lines if line["type"] == "point"]
    pick = min if worst_end(study.output) == "min" else max
    found = []
    for place, axis in enumerate(axes):
        paths = axis["path"] if isinstance(axis["path"], list) else [axis["path"]]
        titles = dict.fromkeys(
            scalar_at(study.asked.calculation.request, path, "", "unknown_path").title for path in paths
        )
        reached, decides = dict[str, float](), ""
        for value in axis["values"]:
            known = [line["out"][0] for line in points if line["at"][place] == value and line["out"][0] is not None]
            each = value if isinstance(value, list) else [value] * len(paths)
            text = _choice(each, axis["unit"])
            if known:
                reached[text] = pick(known)
            if all(worst[path] == own for path, own in zip(paths, each, strict=True)):
                decides = text
        found.append(Uncertain(listed(list(titles)), reached, decides))
    return found


def _choice(values: list[Any], unit: str | None) -> str:
    texts = dict.fromkeys(values) if len(set(values)) == 1 else values
    return ", ".join(number(each) if isinstance(each, int | float) else str(each) for each in texts) + (
        f" {unit}" if unit else ""
    )


def _extremes(study: PageStudy, header: Line, extremes: dict[str, Line], case: Case) -> Table:
    """Every output between its ends, each of which leads to its corner."""
    rows = []
    for each in header["outputs"]:
        if each["path"] in extremes:
            ends = [extremes[each["path"]][end] for end in ("min", "max")]
            rows.append(
                (
                    Cell(each["title"]),
                    Cell(shown(value_at(case.response, each["path"])), right=True),
                    *(Cell(shown(end["value"]), address_at(study.asked, end["at"]), right=True) for end in ends),
                    Cell(each["unit"] or ""),
                )
            )
    head = (Cell("output"), *(Cell(text, right=True) for text in ("as described", "least", "largest")), Cell("unit"))
    return Table("Over all corners", head, tuple(rows), "A number leads to the case at its corner.")


CORNERS = StudyPage(
    link=study_links.CORNERS,
    question="which corner is worst?",
    about=f"Every combination of the uncertain inputs: {USUAL_RANGES}.",
    figures=("corners", LOAD_ALONE.name),
    body=_body,
    plan=corners_study,
    result=_result,
    outputs=(OUTPUT,),
    controls=_controls,
    ranges=ranges_of,
)
