"""Corners: an output over every combination of the uncertain inputs of a unit, and the load at the worst one."""

from dataclasses import replace
from typing import Any

from app.figures.comparison import compared
from app.figures.data import Axis, Figure, NoFigure
from app.figures.models.drive_train import LOAD_ALONE
from app.figures.studies import Uncertain, corners
from app.figures.wording import listed, number
from app.pages import study_links
from app.pages.cases import Case
from app.pages.query import body_of
from app.pages.studies.declaration import Cell, Lead, PageStudy, Result, StudyPage, Table, address_at, case_at
from app.pages.typesetting import shown
from app.pages.views import Asked
from app.schema.fields import Leaf, headlines
from app.studies.drive_train import needs_film_or_state
from app.studies.fields import scalar_at, value_at
from app.studies.requests import USUAL_RANGES, Overrides
from app.studies.stream import Line
from app.studies.sweep import corners_study

OUTPUT = "safety.blok_flank"


def _body(asked: Asked, output: Leaf) -> dict[str, Any]:
    """The usual corners, and beside the output what decides and costs no film."""
    deciding = [leaf.path for leaf in headlines(asked.calculation.response) if not needs_film_or_state(leaf.path)]
    return {
        "request": body_of(asked.calculation.request, asked.pairs),
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
    found = {"corners": corners(Axis(output.title, output.unit), _uncertain(study, lines, worst))}
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
    """Load along the face of a case, and dashed that of the case as described; nothing without load."""
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
        for value in axis["values"]:
            known = [line["out"][0] for line in points if line["at"][place] == value and line["out"][0] is not None]
            if known:
                each = value if isinstance(value, list) else [value] * len(paths)
                found.append(
                    Uncertain(
                        name=listed(list(titles)),
                        choice=_choice(each, axis["unit"]),
                        worst=pick(known),
                        decides=all(worst[path] == own for path, own in zip(paths, each, strict=True)),
                    )
                )
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
    output=OUTPUT,
)
