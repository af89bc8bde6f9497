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
from app.pages.query import CORNER, UNCERTAIN, number_of, text_of
from app.pages.studies.declaration import Controls, Form, Link, Number, PageStudy, Result, StudyPage, Table
from app.pages.studies.sweep import numbered
from app.pages.typesetting import shown
from app.pages.views import REFUSED, Asked
from app.schema.fields import Leaf, headlines
from app.studies.engine import Line
from app.studies.fields import scalar_at, value_at
from app.studies.point_sets import usual_corners
from app.studies.points import COLD, BaseRequest, needs_film
from app.studies.requests import DRIVE_TRAIN, USUAL_RANGES, Overrides
from app.studies.sweep import Corners

OUTPUT = "safety.blok_flank"
CONTROL = {quantity: f"{CORNER}{quantity.replace(' ', '_')}" for quantity in UNCERTAIN}
"""The control of the form for each uncertain input."""


def ranges_of(asked: Asked, left_alone: tuple[str, ...] = ()) -> dict[str, dict[str, Any]]:
    """The values of the uncertain inputs as typed, else the usual ones, by the names of their controls.

    Those of `left_alone` are as in the case where nothing is typed. A case that is refused has none.
    """
    try:
        usual = usual_corners(BaseRequest(asked.calculation, asked.body).checked({}))
    except REFUSED:
        return {}
    found = {}
    for quantity, axis in usual.items():
        name = CONTROL[quantity]
        if text := asked.views.get(name):
            rows = [[number_of(each) for each in row.split()] for row in text.split(";")]
            found[name] = {"path": axis.path, "values": [row[0] if len(row) == 1 else row for row in rows]}
        elif quantity not in left_alone:
            found[name] = axis.model_dump(exclude_none=True)
    return found


def range_controls(form: Form, left_alone: tuple[str, ...] = ()) -> tuple[Controls, ...]:
    """A field for the values of each uncertain input: semicolons between, blanks between inputs that move together."""
    usual = ranges_of(replace(form.asked, views={}))
    fields = []
    for quantity, name in CONTROL.items():
        if axis := usual.get(name):
            rows = [row if isinstance(row, list) else [row] for row in axis["values"]]
            text = "; ".join(" ".join(map(text_of, row)) for row in rows)
            unit = scalar_at(form.asked.calculation.request, _paths(axis)[0], "", "").unit
            label = f"{quantity}, {unit}" if unit else quantity
            fields.append(form.field(name, label, "as in the case" if quantity in left_alone else text))
    about = "Values with semicolons between; blanks between inputs that move together."
    return (Controls("Uncertain inputs", fields=tuple(fields), about=about),)


def _paths(axis: dict[str, Any]) -> list[str]:
    """The inputs of a range, which move together."""
    return [axis["path"]] if isinstance(axis["path"], str) else axis["path"]


def _body(asked: Asked, output: Leaf) -> dict[str, Any]:
    """The corners as typed or usual, and beside the output what decides and costs no film."""
    paths = [leaf.path for leaf in headlines(asked.calculation.response)]
    deciding = [path for path in paths if not (needs_film(DRIVE_TRAIN, path) or path.startswith(COLD))]
    return {
        "request": asked.body,
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
    worst = extremes[output.path]["min" if output.view.greatest_is_best else "max"]["at"]
    outputs = [each["path"] for each in header["outputs"]]
    case, other = study.case({}, outputs), study.case(worst, outputs)
    found = {"corners": corners(axis_of(output), _uncertain(study, lines, worst), value_at(case.response, output.path))}
    found |= load_figure(other, case, "worst corner", "worst corner and, dashed, as described: ")
    return Result(
        progress,
        found,
        (_extremes(study, header, extremes, case), corner_table("The worst corner", study, case, worst)),
        tuple(remarks),
        (
            Link("Open the worst corner", study.address(worst)),
            Link("Its report", study.address(worst, "/report")),
            Link("What to grind", study.asked.study(study_links.DESIGN.name)),
        ),
    )


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


def corner_table(title: str, study: PageStudy, case: Case, corner: Overrides) -> Table:
    """What a corner changes in the case."""
    rows = []
    for path, value in corner.items():
        leaf = study.input(path)
        described = shown(value_at(case.response.inputs, path))
        rows.append((numbered(leaf.title, path), described, shown(value), leaf.unit or ""))
    return Table(title, ("input", Number("as described"), Number("there"), "unit"), tuple(rows))


def _uncertain(study: PageStudy, lines: list[Line], worst: Overrides) -> list[Uncertain]:
    """Of each choice of each axis the worst that the output is with it."""
    points = [line for line in lines if line["type"] == "point"]
    pick = min if study.output.view.greatest_is_best else max
    found = []
    for place, axis in enumerate(lines[0]["axes"]):
        paths = _paths(axis)
        reached, decides = dict[str, float](), ""
        for value in axis["values"]:
            known = [line["out"][0] for line in points if line["at"][place] == value and line["out"][0] is not None]
            each = value if isinstance(value, list) else [value] * len(paths)
            texts = [number(own) if isinstance(own, int | float) else str(own) for own in each]
            text = ", ".join(texts[:1] if len(set(each)) == 1 else texts) + (f" {axis['unit']}" if axis["unit"] else "")
            if known:
                reached[text] = pick(known)
            if [worst[path] for path in paths] == each:
                decides = text
        titles = dict.fromkeys(study.input(path).title for path in paths)
        found.append(Uncertain(listed(list(titles)), reached, decides))
    return found


def _extremes(study: PageStudy, header: Line, extremes: dict[str, Line], case: Case) -> Table:
    """Every output between its ends, each of which leads to its corner."""
    rows = []
    for each in header["outputs"]:
        if each["path"] in extremes:
            ends = [extremes[each["path"]][end] for end in ("min", "max")]
            least, largest = (Link(shown(end["value"]), study.address(end["at"])) for end in ends)
            described = shown(value_at(case.response, each["path"]))
            rows.append((each["title"], described, least, largest, each["unit"] or ""))
    head = ("output", Number("as described"), Number("least"), Number("largest"), "unit")
    return Table("Over all corners", head, tuple(rows), "A number leads to the case at its corner.")


CORNERS = StudyPage(
    link=study_links.CORNERS,
    question="which corner is worst?",
    about=f"Every combination of the uncertain inputs: {USUAL_RANGES}.",
    figures=("corners", LOAD_ALONE.name),
    body=_body,
    plan=Corners,
    result=_result,
    outputs=(OUTPUT,),
    controls=range_controls,
    ranges=ranges_of,
)
