"""The page of a study before, while and after its lines come, and its figures as files; runs in workers."""

from dataclasses import dataclass, replace

from app.calculations import Calculation
from app.errors import Unprocessable, Unreadable
from app.figures.rendering import MEDIA_TYPES, Format, written
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
from app.pages.views import REFUSED, Asked, title_of
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
# The controls of the axes and of the distributions, by the member that is wrong.
RANGE_CONTROLS = {"path": "", "stop": ".to", "count": ".count", "scale": ".scale"}
SCATTER_CONTROLS = {"path": "", "mean": ".about", "median": ".about"}


@dataclass(frozen=True, slots=True)
class Opened:
    """A page around its figures; without a study it is whole."""

    head: bytes
    tail: bytes = b""
    status: int = 200
    study: PageStudy | None = None


def opened(page: StudyPage, asked: Asked, most: int, deadline_s: float) -> Opened:
    """The page of a study of a case, and the study if there is a case."""
    chosen = not page.needs or any(asked.views.get(name) for name in page.needs)
    try:
        study = checked(page, asked, most, deadline_s) if asked.pairs and chosen else None
    except REFUSED as error:
        uncertain = tuple(page.ranges(asked))
        found = faults_of(error, asked.calculation)
        faults = [Fault(control_at_fault(each.path, uncertain), each.message) for each in found]
        return Opened(_page(page, asked, None, faults).encode(), status=400 if isinstance(error, Unreadable) else 422)
    head, _, tail = _page(page, asked, study, []).partition(FRAMES)
    return Opened(head.encode(), tail.encode(), study=study)


def checked(page: StudyPage, asked: Asked, most: int, deadline_s: float) -> PageStudy:
    """The study that is asked for; raises what refuses it, with paths into the study."""
    output = output_of(page, asked.calculation, asked.views.get("show"))
    return PageStudy(page, asked, output, page.plan(page.body(asked, output), most, deadline_s))


def output_of(page: StudyPage, calculation: Calculation, path: str | None = None) -> Leaf:
    """The output at a path, or the one that a page shows when none is chosen; raises Unprocessable."""
    response = calculation.response
    usual = next((each for each in page.outputs if leaf_at(response, each)), headlines(response)[0].path)
    output = scalar_at(response, path or usual, "outputs.0", "unknown_output")
    if output.kind not in NUMBERS:
        raise Unprocessable("unknown_output", f"{output.path} is no number", "outputs.0")
    return output


def output_choices(calculation: Calculation) -> list[Choice]:
    """Every number of the answer that a study can show, the headlines first."""
    response = calculation.response
    first = headlines(response)
    titles = {branch.path: branch.title for branch in tree(response).branches}
    choices = []
    for leaf in (*first, *(leaf for leaf in leaves(response) if leaf not in first)):
        section, *inner = leaf.path.split(".")
        whole = leaf.is_scalar and leaf.kind in NUMBERS and leaf.detail == "summary" and ITEM not in inner
        if whole and section not in NOT_RESULTS:
            group = "numbers that decide" if leaf in first else titles.get(section, "result")
            choices.append(Choice(leaf.path, f"{leaf.title}, {leaf.unit}" if leaf.unit else leaf.title, group))
    return choices


def control_at_fault(path: str, uncertain: tuple[str, ...] = ()) -> str:
    """The control of the form that a path into the study means; a field of the case keeps its own name.

    `uncertain` are the controls of the uncertain inputs in their order.
    """
    match path.split("."):
        case ["request", *rest]:
            control = ".".join(rest)
        case ["vary"]:
            control = "x.count"
        case ["vary", place, *part]:
            control = AXES[int(place)] + RANGE_CONTROLS.get(".".join(part), ".from")
        case ["ranges" | "corners", *place] if uncertain:
            control = uncertain[int(place[0]) if place else 0]
        case ["variables", place, *part]:
            control = f"{UPPER if part == ['max'] else LOWER}{place}"
        case ["tolerances", "inputs"]:
            control = "t0"
        case ["tolerances", "inputs", place, *part]:
            control = f"t{place}{SCATTER_CONTROLS.get('.'.join(part), '.by')}"
        case [head, *_]:
            control = CONTROLS.get(head, path)
    return control


def _page(page: StudyPage, asked: Asked, study: PageStudy | None, faults: list[Fault]) -> str:
    calculation = asked.calculation
    form = Form(asked, {fault.path: fault.message for fault in faults}, study is not None)
    show = form.menu("show", "output", output_of(page, calculation).title, output_choices(calculation))
    groups = (*page.controls(form), Controls("Show", show, page.shows(form)))
    controls = {each.name for group in groups for each in (group.menu, *group.fields) if each}
    theme = asked.views.get("theme", "")
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
        hidden=[pair for pair in (*asked.pairs, ("theme", theme)) if pair[1]],
        faults=[fault for fault in faults if fault.path not in controls],
        refused=bool(faults),
        theme=theme,
        study=study,
        starters=[] if study or faults else page.starters(page.link.name, asked),
        frames=FRAMES,
    )


def partial(study: PageStudy, lines: list[Line], done: int) -> bytes:
    """How far the study is, and what the lines so far show; none are given of a study that does not grow."""
    return _result(study, study.page.result(study, lines) if lines else Result(""), done=done)


def whole(study: PageStudy, lines: list[Line]) -> bytes:
    """Figures, tables and links; a study that ended early says why, and shows what it found."""
    *before, last = lines
    if last["type"] == "end":
        return _result(study, study.page.result(study, lines))
    found = study.page.result(study, lines) if study.page.grows and before else Result("")
    return _result(study, found, problem=last["message"], done=last["done"])


def _result(study: PageStudy, found: Result, *, problem: str = "", done: int | None = None) -> bytes:
    charts = [embedded(name, figure, study.asked.theme) for name, figure in found.figures.items()]
    if charts:
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
    return written(found.figures[name], image_format, study.asked.theme or "light")


def report(study: PageStudy, lines: list[Line], host: str) -> bytes:
    """The report of the case, with a section about the study."""
    found = study.page.result(study, lines)
    section = {
        "title": study.page.link.label,
        "link": "" if study.links.too_long else study.links.view(""),
        "found": found,
    }
    return case_report(study.asked, host, section).content
