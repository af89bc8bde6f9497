"""The page of a study before, during and after the calculation, and the figures of the study as files.

The functions of this module run in workers.
"""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from http import HTTPStatus
from itertools import groupby
from typing import Any, NamedTuple

from app.calculations import Calculation
from app.errors import Unprocessable, Unreadable
from app.figures import Format, written
from app.figures.data import Figure
from app.pages.cases import CARRIED_NAMES, REFUSED, Asked, FormFault, SolvedCase, faults_of, solved
from app.pages.charts import embedded
from app.pages.form import FieldView
from app.pages.pair_path import path_of
from app.pages.query import LONGEST_QUERY, link, pairs_of, written_of
from app.pages.results import NOT_RESULTS
from app.pages.studies.controls import Choice, Control, Menu, Options, body_of
from app.pages.study_kinds import CASES, DESIGN, FIND, OIL_TESTS, StudyLink, control_names
from app.pages.study_links import Starter, StudyExample
from app.pages.templating import examples_of, rendered
from app.pages.typed import as_typed, question, text_of
from app.pages.views import report as case_report
from app.schema.fields import ITEM, Leaf, headlines, leaf_at, leaves, tree
from app.sources import SHORT_SOURCES
from app.studies.fields import NUMBERS, scalar_at
from app.studies.oil_tests import NAME
from app.studies.points import reduced_request, with_overrides
from app.studies.requests import Overrides, Scalar
from app.studies.runner import Line, Progress, Study

FRAMES = "<!-- the figures -->"
OUTPUT = Control("show", "outputs", sets=False)
"""The menu of outputs, which every page has."""


class Controls(NamedTuple):
    """A group of controls in a study's form. If `about` is not empty, each of the controls stands on its own line.

    The menus in `more` are folded until one of them has a choice.
    """

    title: str
    menu: Menu | None = None
    fields: tuple[FieldView, ...] = ()
    about: str = ""
    more: tuple[Menu, ...] = ()

    @property
    def menus(self) -> tuple[Menu, ...]:
        """All menus of the group."""
        return (self.menu, *self.more) if self.menu else self.more


class Number(str):
    """The heading of a column of numbers. The column is aligned to the right."""

    __slots__ = ()


class Link(NamedTuple):
    """A link in a table or above the result; screen readers read the `label`, if there is one, instead of the text."""

    text: str
    address: str
    label: str = ""


class Table(NamedTuple):
    """A table with a title above it and a note below it. A folded table shows its rows only after a click."""

    title: str
    head: tuple[str, ...]
    rows: Sequence[tuple[str | Link, ...]]
    note: str = ""
    folded: bool = False

    @property
    def right(self) -> list[bool]:
        """One boolean per column: True if the column contains numbers and is therefore aligned to the right."""
        return [isinstance(heading, Number) for heading in self.head]


@dataclass(frozen=True, slots=True)
class Result:
    """The result of a study. The page shows the tables in `first`, then the figures, then the other tables.

    `answer` is a sentence that answers the question of the study. `leads` are links above the result. `script` is JSON
    for the script of the page. With this script, a click on a point in the first figure opens the case of this point.
    """

    progress: str
    figures: dict[str, Figure] = field(default_factory=dict)
    tables: tuple[Table, ...] = ()
    remarks: tuple[str, ...] = ()
    leads: tuple[Link, ...] = ()
    script: str = ""
    first: tuple[Table, ...] = ()
    answer: str = ""


class StudyPage(ABC):
    """The page of a study of a case. Each kind of study has its own class, and each query has its own instance.

    Attributes
    ----------
    link, question, about
        Link to the page, heading of the page, and sentence below the heading.
    figures
        Names of all figures that the page can show.
    template
        Template of the result.
    outputs
        Preferred outputs. If the user chooses no output, the page shows the first preferred output that the answer has.
        If the answer has none of the preferred outputs, the page shows the first headline number.
    grows
        Whether the page shows a result while the study runs. If not, the page shows only the progress until the study
        has ended.
    shows_title
        Title of the group of controls with the menu of outputs.
    needs, choose
        Controls of which at least one must be filled in to start a study, and the sentence that asks the user to do so.
    plan
        The class of the study. Its arguments are the body, the largest number of points, and the deadline of a point
        [s].
    case
        The case, as far as the query states the case.
    study
        The study, or None until the query has been accepted.
    faults
        The errors of a rejected query. An error has the name of the control at which the error is shown.

    """

    link: StudyLink
    question: str
    about: str
    figures: tuple[str, ...]
    template = "study_result.html"
    outputs: tuple[str, ...] = ()
    grows = False
    needs: tuple[str, ...] = ()
    choose = ""
    shows_title = "Show"
    plan: type[Study]

    def __init__(self, asked: Asked) -> None:
        self.asked = asked
        self.views = asked.views
        self.case = asked.case
        self.study: Any = None
        self.faults: list[FormFault] = []

    @abstractmethod
    def body(self) -> dict[str, Any]:
        """Return the body of the request to the endpoint of the study; raise Unprocessable if the query is invalid."""

    @abstractmethod
    def result(self, lines: list[Line]) -> Result:
        """Return the content of the result that the page shows, from the lines of the study's answer."""

    def controls(self) -> tuple[Controls, ...]:
        """Return the groups of controls above the menu of outputs."""
        return ()

    def shows(self) -> tuple[FieldView, ...]:
        """Return the form fields that stand next to the menu of outputs. The base class has no such fields."""
        return ()

    def also_shows(self) -> tuple[Menu, ...]:
        """Return menus of further outputs. The base class has none."""
        return ()

    def declared(self) -> tuple[Control, ...]:
        """Return all controls except the menu of outputs. A control states which part of the body it sets.

        This method must not raise errors, because the page of a rejected query needs the controls, too.
        """
        return ()

    def given(self) -> dict[str, Any]:
        """Return the parts of the body that the declared controls set."""
        return body_of(self.declared(), self.views)

    def starters(self) -> Sequence[Starter | StudyExample]:
        """Return a link to a ready study for each example. If the query has a case, return no links."""
        examples = () if self.asked.pairs else examples_of(self.calculation)
        path = f"{self.asked.path}/{self.link.name}"
        return [Starter(example.title, example.source, link(path, pairs_of(example.request))) for example in examples]

    @property
    def calculation(self) -> Calculation:
        """The calculation to which the case of the study belongs."""
        return self.asked.calculation

    @property
    def usual_output(self) -> Leaf:
        """The output that is shown if the user chooses no output."""
        response = self.calculation.response
        preferred = (leaf for path in self.outputs if (leaf := leaf_at(response, path)))
        return next(preferred, headlines(response)[0])

    @cached_property
    def output(self) -> Leaf:
        """The output that the page shows. Raises Unprocessable if the query names an output that is not a number."""
        return self.output_at(self.views.get("show") or self.usual_output.path, "outputs.0")

    def output_at(self, path: str, place: str) -> Leaf:
        """Return the output at a path; raise Unprocessable at `place` if the path leads to no number."""
        output = scalar_at(self.calculation.response, path, place, "unknown_output")
        if output.kind not in NUMBERS:
            raise Unprocessable("unknown_output", f"{output.title} is not a number; choose another output", place)
        return next((end for end in worst_ends(self.calculation).values() if end.path == path), output)

    def menu(self, name: str, label: str, empty: str, choices: list[Choice]) -> Menu:
        """Return a menu of the given choices. If the query names another choice, the menu also has this choice."""
        chosen, labels = self.views.get(name, ""), {choice.path: choice.label for choice in choices}
        groups = [(group, list(items)) for group, items in groupby(choices, key=lambda choice: choice.group)]
        if chosen and chosen not in labels:
            groups.append(("asked for", [Choice(chosen, chosen, "")]))
        shown = labels.get(chosen, chosen) or empty
        return Menu(name, label, empty, chosen, shown, groups, dict(self.faults).get(name))

    def field(self, name: str, label: str, usual: Scalar = None, unit: str = "", options: Options = ()) -> FieldView:
        """Return a form field with the typed text, and with the usual value as placeholder."""
        return FieldView(
            name=name,
            label=label,
            unit=unit,
            widget="select" if options else "text" if isinstance(usual, str) else "number",
            text=as_typed(self.views.get(name, "")),
            placeholder="" if usual is None else text_of(usual),
            options=options,
            fault=dict(self.faults).get(name),
        )

    def field_of(self, control: Control) -> FieldView:
        """Return the form field of a declared control, with its default as placeholder."""
        return self.field(control.name, control.label, control.default, control.unit, control.options)

    def control_at(self, path: str) -> str:
        """Return the name of the control at which an error of the request body at `path` is shown.

        If no control sets the part of the body at `path`, use the control that sets the nearest enclosing part. If no
        control sets an enclosing part, return `path`. If several controls set the same part, use the last one.
        """
        parts = path.split(".")
        if parts[0] == "request":
            return ".".join(parts[1:])
        names = {control.path: control.name for control in (OUTPUT, *self.declared())}
        above = (".".join(parts[:end]) for end in range(len(parts), 0, -1))
        return next((names[part] for part in above if part in names), path)

    def view(self, below: str) -> str:
        """Return the address of a file, a figure or the report of this page."""
        kept = control_names() | {"theme", *CARRIED_NAMES}
        views = {name: text for name, text in self.views.items() if name in kept}
        return link(f"{self.asked.path}/{self.link.name}{below}", self.asked.pairs, **views, sources=SHORT_SOURCES)

    @property
    def too_long(self) -> bool:
        """Whether the query of this page is too long for a link."""
        return len(self.view("").partition("?")[2]) > LONGEST_QUERY

    def other(self, kind: StudyLink, **changes: str) -> str:
        """Return the address of a study of this case, with the controls of this page and some changes."""
        views = {name: text for name, text in self.views.items() if name in kind.controls | {"show", "theme"}}
        return link(f"{self.asked.path}/{kind.name}", self.asked.pairs, **(views | changes), **self.asked.carried)

    def oil_links(self, *, held: bool) -> tuple[Link, ...]:
        """Return links to what a study over the oil can do about the tests of the oil, other than what it does."""
        other = Link("Let the limits follow the stages", self.other(self.link, **{OIL_TESTS: "by_stage"}))
        if not held:
            other = Link("Hold the limits of the case", self.other(self.link, **{OIL_TESTS: "held"}))
        return other, Link(
            "Compare oils with stages of their own", self.other(FIND, x=NAME, **{"x.from": "", "x.to": ""})
        )

    def image(self, figure: str, image_format: str) -> str:
        """Return the address at which a figure of the study can be downloaded as a file."""
        return self.view(f"/figures/{figure}.{image_format}")

    def field_at(self, path: str) -> Leaf | None:
        """Return the field of the request at a path from the query, or None if the path leads to no single value."""
        try:
            return self.input(path)
        except Unprocessable:
            return None

    def input(self, path: str) -> Leaf:
        """Return the field of the request at a path; raise Unprocessable if the path leads to no single value."""
        return scalar_at(self.calculation.request, path, "", "unknown_path")

    def address(self, overrides: Overrides, below: str = "", **views: str) -> str:
        """Return the address of the case with the values of one point of the study."""
        body = with_overrides(self.calculation, self.asked.body, overrides)
        del body["detail"]
        return link(f"{self.asked.path}{below}", pairs_of(body), theme=self.asked.theme, **self.asked.carried, **views)

    def solved(self, overrides: Overrides) -> SolvedCase:
        """Return the case with the values of one point of the study, and with the answer for this point."""
        body = with_overrides(self.calculation, self.asked.body, overrides)
        outputs = [leaf.path for leaf in self.study.outputs]
        return solved(self.calculation, pairs_of(reduced_request(self.calculation.path, body, outputs)), None)


class Opened(NamedTuple):
    """A study page that is cut into `head` and `tail`. The result of a running study is sent between both parts."""

    page: StudyPage
    status: int
    head: bytes
    tail: bytes


def opened(kind: type[StudyPage], asked: Asked, most: int, deadline_s: float) -> Opened:
    """Return the page for a query. The page has the study that the query asks for, or the errors of a rejected query.

    `most` is the largest number of points of a study, and `deadline_s` is the deadline of a point [s].
    """
    page, status = kind(asked), 200
    try:
        if asked.pairs and (not page.needs or any(asked.views.get(name) for name in page.needs)):
            page = checked(kind, asked, most, deadline_s)
    except REFUSED as error:
        status = 400 if isinstance(error, Unreadable) else 422
        at_controls = [(page.control_at(fault.path), fault.message) for fault in faults_of(error, page.calculation)]
        # A message about a fault in the table of cases names the line of the fault. Such a message is therefore not
        # replaced by a question.
        texts = {name: text for name, text in asked.views.items() if name != CASES}
        page.faults = [FormFault(name, question(texts.get(name, "")) or message) for name, message in at_controls]
    show = page.menu("show", "output", page.usual_output.title, output_choices(page.calculation))
    groups = (*page.controls(), Controls(page.shows_title, show, page.shows(), more=page.also_shows()))
    controls = {menu.name for group in groups for menu in group.menus}
    controls |= {field.name for group in groups for field in group.fields}
    texts = {field.name: field.text for group in groups for field in group.fields} | asked.views
    content = rendered(
        "study.html",
        asked.root,
        page=page,
        asked=asked,
        calculation=page.calculation,
        groups=groups,
        hidden=[pair for pair in (*asked.pairs, ("theme", asked.theme), *asked.carried.items()) if pair[1]],
        other_faults=[fault for fault in page.faults if fault.path not in controls],
        written=written_of(asked.calculation.request, [*asked.pairs, *texts.items()]),
        path=path_of(asked, page.link.name) if page.link == DESIGN else [],
        frames=FRAMES,
    )
    head, _, tail = content.partition(FRAMES)
    return Opened(page, status, head.encode(), tail.encode())


def checked(kind: type[StudyPage], asked: Asked, most: int, deadline_s: float) -> StudyPage:
    """Return the page with the study that the query asks for."""
    page = kind(asked)
    page.study = page.plan(page.body(), most, deadline_s)
    return page


def output_choices(calculation: Calculation) -> list[Choice]:
    """Return the outputs that a study can show. The headline numbers come first."""
    response = calculation.response
    first = headlines(response)
    titles = {branch.path: branch.title for branch in tree(response).branches}
    choices, worst = [], worst_ends(calculation)
    for leaf in (*first, *(leaf for leaf in leaves(response) if leaf not in first)):
        section, *inner = leaf.path.split(".")
        is_single = leaf.is_scalar and leaf.kind in NUMBERS and leaf.detail == "summary" and ITEM not in inner
        if is_single and section not in NOT_RESULTS:
            group = "numbers that decide" if leaf in first else titles.get(section, "result")
            choices.append(Choice(leaf.path, titled(leaf), group))
            if end := worst.get(leaf.path):
                choices.append(Choice(end.path, titled(end), group))
    return choices


def worst_ends(calculation: Calculation) -> dict[str, Leaf]:
    """Return the worst ends of the bands of headline numbers, by the paths of the headline numbers."""
    ends = {}
    for leaf in headlines(calculation.response):
        if leaf.view.band:
            path = f"{leaf.view.band}.{0 if leaf.view.greatest_is_best else 1}"
            view = replace(leaf.view, headline=None, verdict=None, band=None)
            ends[leaf.path] = replace(leaf, path=path, title=f"{leaf.title} at the worst end", view=view)
    return ends


def titled(leaf: Leaf) -> str:
    """Return the title of a field with its unit."""
    return f"{leaf.title}, {leaf.unit}" if leaf.unit else leaf.title


def drawn(page: StudyPage, lines: list[Line], progress: Progress | None = None) -> bytes:
    """Return the result of a study as HTML with figures, tables and links.

    `progress` is given while the study runs. If the study ended early, the HTML begins with the reason; without a
    `progress`, it names the number of points that were planned.
    """
    *before, last = lines or [{"type": "progress"}]
    ended_early = last["type"] == "error"
    has_result = last["type"] == "end" or (page.grows and (before if ended_early else lines))
    result = page.result(lines) if has_result else Result("")
    grows = progress is not None and not ended_early
    charts = [embedded(name, figure, page.asked.theme, grows=grows) for name, figure in result.figures.items()]
    if charts:
        charts[0] = replace(charts[0], study=result.script)
    return rendered(
        page.template,
        page.asked.root,
        page=page,
        found=result,
        problem=last["message"] if ended_early else "",
        progress=progress or (Progress(last["done"], page.study.total) if ended_early else None),
        charts=charts,
    ).encode()


def file(page: StudyPage, lines: list[Line], name: str, image_format: Format) -> bytes | str:
    """Return a figure as a file, or the reason why the study has no figure of this name."""
    result = page.result(lines)
    if name not in result.figures:
        return "; ".join([f"This study has the figures {', '.join(result.figures) or 'none'}", *result.remarks])
    return written(result.figures[name], image_format, page.asked.theme or "light")


def report_progress(page: StudyPage, progress: Progress, *, has_ended: bool = False, problem: str = "") -> bytes:
    """Return the part of the document with the number of solved points, or with the reason why there is no report."""
    content = {"page": page, "progress": progress, "has_ended": has_ended, "problem": problem}
    return rendered("report_points.html", page.asked.root, **content).encode()


def report(page: StudyPage, lines: list[Line], host: str) -> bytes:
    """Return the style sheet and the body of a case's report, with a section about the study."""
    section = {
        "title": page.link.label,
        "link": "" if page.too_long else page.view(""),
        "found": page.result(lines),
    }
    shown = case_report(page.asked, host, section)
    if shown.status != HTTPStatus.OK:
        problem = "The case that the study varies cannot be calculated. The page of this case states the reason."
        return report_progress(page, Progress(page.study.total, page.study.total), problem=problem)
    head, _, body = shown.content.partition(b"<body>")
    return head[head.index(b"<style>") : head.index(b"</head>")] + body
