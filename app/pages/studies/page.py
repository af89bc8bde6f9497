"""The page of a study before, while and after its lines come, and its figures as files; runs in workers."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from app.calculations import Calculation
from app.errors import Unprocessable, Unreadable
from app.figures.rendering import MEDIA_TYPES, Format, written
from app.figures.tables import table
from app.pages.cases import Fault, faults_of
from app.pages.charts import embedded
from app.pages.query import LOWER, TRIALS, UPPER
from app.pages.results import NOT_RESULTS
from app.pages.studies.corners import CORNERS
from app.pages.studies.declaration import Choice, Controls, Form, PageStudy, Result, StudyAddresses, StudyPage
from app.pages.studies.design import DESIGN
from app.pages.studies.sensitivity import SENSITIVITY
from app.pages.studies.spectrum import SPECTRUM
from app.pages.studies.sweep import AXES, SWEEP
from app.pages.templating import rendered
from app.pages.views import REFUSED, Asked, StudySection, title_of
from app.pages.views import report as case_report
from app.schema.fields import ITEM, Leaf, headlines, leaf_at, leaves, tree
from app.studies.engine import Line
from app.studies.fields import NUMBERS, scalar_at

PAGES = {each.link: each for each in (SWEEP, SENSITIVITY, SPECTRUM, CORNERS, DESIGN)}
FRAMES = "<!-- the figures -->"
# The control that a part of a study means, whatever of it is wrong.
CONTROLS = {
    "evaluations": TRIALS,
    "outputs": "show",
    "objective": "show",
    "cases": "cases",
    "limits": "limit",
    "tolerances": "machines",
    "hours_per_year": "hours",
}


@dataclass(frozen=True, slots=True)
class Opened:
    """A page around its figures; without a study it is whole."""

    head: bytes
    tail: bytes = b""
    status: int = 200
    study: PageStudy | None = None


def opened(page: StudyPage, asked: Asked, most: int, deadline_s: float) -> Opened:
    """The page of a study of a case, and the study if there is a case."""
    try:
        study = checked(page, asked, most, deadline_s) if asked.pairs and page.complete(asked) else None
    except REFUSED as error:
        controls = list(page.ranges(asked))
        found = faults_of(error, asked.calculation)
        faults = [Fault(field_at_fault(each.path, controls), each.message) for each in found]
        status = 400 if isinstance(error, Unreadable) else 422
        return Opened(_page(page, asked, None, faults).encode(), status=status)
    head, _, tail = _page(page, asked, study, []).partition(FRAMES)
    return Opened(head.encode(), tail.encode(), study=study)


def checked(page: StudyPage, asked: Asked, most: int, deadline_s: float) -> PageStudy:
    """The study that is asked for; raises what refuses it, with paths into the study."""
    output = _output(page, asked.calculation, asked.views)
    return PageStudy(page, asked, output, page.plan(page.body(asked, output), most, deadline_s))


def _output(page: StudyPage, calculation: Calculation, views: dict[str, str]) -> Leaf:
    usual = next((path for path in page.outputs if leaf_at(calculation.response, path)), None)
    return output_at(calculation, views.get("show", usual))


def output_choices(calculation: Calculation) -> list[Choice]:
    """Every number of the answer that a study can show, the headlines first."""
    response = calculation.response
    first = headlines(response)
    titles = {branch.path: branch.title for branch in tree(response).branches}
    found = [(leaf, "numbers that decide") for leaf in first]
    found += [
        (leaf, titles.get(leaf.path.partition(".")[0], "result")) for leaf in leaves(response) if leaf not in first
    ]
    return [
        Choice(leaf.path, f"{leaf.title}, {leaf.unit}" if leaf.unit else leaf.title, group)
        for leaf, group in found
        if _can_be_shown(leaf)
    ]


def _can_be_shown(leaf: Leaf) -> bool:
    whole = leaf.is_scalar and leaf.kind in NUMBERS and leaf.detail == "summary" and ITEM not in leaf.path.split(".")
    return whole and leaf.path.partition(".")[0] not in NOT_RESULTS


def output_at(calculation: Calculation, path: str | None) -> Leaf:
    """The output at a path, or the first headline where none is given; raises Unprocessable."""
    output = scalar_at(
        calculation.response, path or headlines(calculation.response)[0].path, "outputs.0", "unknown_output"
    )
    if output.kind not in NUMBERS:
        raise Unprocessable("unknown_output", f"{output.path} is no number", "outputs.0")
    return output


def field_at_fault(path: str, ranges: Sequence[str] = ()) -> str:
    """The control of the form that a path into the study means; a field of the case keeps its own name.

    `ranges` are the controls of the uncertain inputs in their order.
    """
    head, _, rest = path.partition(".")
    place, _, part = rest.partition(".")
    name = path
    match head:
        case "vary":
            axis = AXES[int(place)] if place in {"0", "1"} else "x"
            known = {"path": "", "stop": ".to", "count": ".count", "scale": ".scale"}
            name = axis + (known.get(part, ".from") if place else ".count")
        case "ranges" | "corners" if ranges:
            name = ranges[int(place) if place else 0]
        case "variables":
            name = f"{UPPER if part == 'max' else LOWER}{place}"
        case "tolerances" if place == "inputs":
            number, _, member = part.partition(".")
            name = f"t{number}" + {"path": "", "mean": ".about", "median": ".about"}.get(member, ".by")
        case "request":
            name = rest
        case _:
            name = CONTROLS.get(head, path)
    return name


def _page(page: StudyPage, asked: Asked, study: PageStudy | None, faults: list[Fault]) -> str:
    calculation = asked.calculation
    form = Form(asked, {fault.path: fault.message for fault in faults}, study is not None)
    show = form.menu("show", "output", _output(page, calculation, {}).title, output_choices(calculation))
    groups = (*page.controls(form), Controls("Show", show, page.shows(form)))
    controls = [each for group in groups for each in (group.menu, *group.fields) if each]
    return rendered(
        "study.html",
        asked.root,
        calculation=calculation,
        page=page,
        path=asked.path,
        case_links=asked,
        field_title=lambda path: title_of(calculation, path),
        outdated=asked.outdated,
        links=StudyAddresses(page.link.name, asked),
        groups=groups,
        hidden=[pair for pair in (*asked.pairs, ("theme", asked.views.get("theme", ""))) if pair[1]],
        faults=[fault for fault in faults if fault.path not in {each.name for each in controls}],
        refused=bool(faults),
        theme=asked.views.get("theme", ""),
        study=study,
        starters=[] if study or faults else page.starters(page, asked),
        frames=FRAMES,
    )


def partial(study: PageStudy, lines: list[Line], done: int) -> bytes:
    """How far the study is, and what the lines so far show."""
    found = study.page.result(study, lines) if study.page.grows and lines else Result("")
    return _result(study, found, done=done)


def whole(study: PageStudy, lines: list[Line]) -> bytes:
    """Figures, tables and links; a study that ended early says why, and shows what it found."""
    if lines[-1]["type"] == "end":
        return _result(study, study.page.result(study, lines))
    found = study.page.result(study, lines) if study.page.grows and len(lines) > 1 else Result("")
    return _result(study, found, problem=lines[-1]["message"], done=lines[-1]["done"])


def _result(study: PageStudy, found: Result, *, problem: str = "", done: int | None = None) -> bytes:
    charts = [embedded(name, figure, study.asked.theme) for name, figure in found.figures.items()]
    if charts and found.script:
        charts[0] = replace(charts[0], study=found.script)
    return rendered(
        "study_result.html",
        study.asked.root,
        study=study,
        found=found,
        problem=problem,
        done=done,
        charts=charts,
        links=study.links,
        formats=MEDIA_TYPES,
    ).encode()


def file(study: PageStudy, lines: list[Line], name: str, image_format: Format) -> bytes | str:
    """One figure as a file, or why the study has none of this name."""
    found = study.page.result(study, lines)
    if name not in found.figures:
        return "; ".join([f"This study has the figures {', '.join(found.figures) or 'none'}", *found.remarks])
    figure = found.figures[name]
    return table(figure) if image_format == "csv" else written(figure, image_format, study.asked.theme or "light")


def report(study: PageStudy, lines: list[Line], host: str) -> bytes:
    """The report of the case, with a section about the study."""
    found = study.page.result(study, lines)
    section = StudySection(
        title=study.page.link.label,
        progress=found.progress,
        remarks=found.remarks,
        figures=found.figures,
        tables=found.tables,
        link="" if study.links.too_long else study.links.view(""),
    )
    return case_report(study.asked, host, section).content
