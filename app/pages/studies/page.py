"""The page of a study before, while and after its lines come, and its figures as files; runs in workers."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import groupby
from typing import Any, NamedTuple

from app.calculations import Calculation
from app.errors import Unprocessable, Unreadable
from app.figures.data import Figure
from app.figures.rendering import MEDIA_TYPES, Format, written
from app.pages.cases import Case, Fault, faults_of, solved
from app.pages.charts import embedded
from app.pages.form import FieldView
from app.pages.query import LONGEST_QUERY, STUDY_NAMES, link, number_of, pairs_of, text_of
from app.pages.results import NOT_RESULTS
from app.pages.study_links import Starter, StudyExample, StudyLink
from app.pages.templating import examples_of, rendered
from app.pages.views import REFUSED, Asked, title_of
from app.pages.views import report as case_report
from app.schema.fields import ITEM, Leaf, headlines, leaf_at, leaves, tree
from app.sources import SHORT_SOURCES
from app.studies.engine import Line, Study
from app.studies.fields import NUMBERS, scalar_at
from app.studies.points import reduced_request, with_overrides
from app.studies.requests import Overrides, Scalar

FRAMES = "<!-- the figures -->"
Options = tuple[tuple[str, str], ...]


class Choice(NamedTuple):
    """An entry of a menu, in a group."""

    path: str
    label: str
    group: str


class Menu(NamedTuple):
    """A choice in groups; `empty` is the label of no choice, `shown` that of `chosen`, which a narrow menu may cut."""

    name: str
    label: str
    empty: str
    chosen: str
    shown: str
    groups: list[tuple[str, list[Choice]]]
    fault: str | None


class Controls(NamedTuple):
    """A group of the controls of a study's form; with a text on how to fill them in, each takes a line."""

    title: str
    menu: Menu | None = None
    fields: tuple[FieldView, ...] = ()
    about: str = ""


class Number(str):
    """The heading of a column of numbers, which stand right."""

    __slots__ = ()


class Link(NamedTuple):
    """A link in a table or above the result; `label` is what a screen reader says where its text says too little."""

    text: str
    address: str
    label: str = ""


class Table(NamedTuple):
    """A table under its title, and what there is to say of it; a folded one is opened by a click."""

    title: str
    head: tuple[str, ...]
    rows: Sequence[tuple[str | Link, ...]]
    note: str = ""
    folded: bool = False

    @property
    def right(self) -> list[bool]:
        """Which columns have numbers."""
        return [isinstance(heading, Number) for heading in self.head]


@dataclass(frozen=True, slots=True)
class Result:
    """What a page shows of the lines of a study: the `first` tables, figures by their names, more tables.

    `leads` are links to go on from the result. `script` is JSON for the script of the page, with which a click into
    the first figure opens the case of a point.
    """

    progress: str
    figures: dict[str, Figure] = field(default_factory=dict)
    tables: tuple[Table, ...] = ()
    remarks: tuple[str, ...] = ()
    leads: tuple[Link, ...] = ()
    script: str = ""
    first: tuple[Table, ...] = ()


class StudyPage(ABC):
    """A study of a case on a page of its own: a class for each kind of study, an instance for what a query asks.

    The output shown when none is chosen is the first of `outputs` that the answer has, else the first headline. `most`
    is the setting that bounds the points of the study. A page that `grows` shows its result while the lines come, the
    others only how far they are. Without one of the controls in `needs` there is no study, and `choose` asks for it.
    `figures` names all that there may be, `files` the forms in which the lines are offered. `plan` makes the study of
    a body, of at most so many points.

    `study` is None until the query is found to ask for one, `faults` are what it is refused for, by control.
    """

    link: StudyLink
    question: str
    about: str
    figures: tuple[str, ...]
    outputs: tuple[str, ...] = ()
    grows = False
    most = "most_study_points"
    needs: tuple[str, ...] = ()
    choose = ""
    files: tuple[str, ...] = ("ndjson",)
    plan: Callable[[dict[str, Any], int, float], Study]

    def __init__(self, asked: Asked) -> None:
        self.asked = asked
        self.views = asked.views
        self.study: Any = None
        self.faults: list[Fault] = []

    @abstractmethod
    def body(self) -> dict[str, Any]:
        """What the endpoint of the study is asked; raises Unprocessable."""

    @abstractmethod
    def result(self, lines: list[Line]) -> Result:
        """What the page shows of the lines; with `grows` also of those that have come while the study runs."""

    def controls(self) -> tuple[Controls, ...]:
        """What the form has beside the output."""
        return ()

    def shows(self) -> tuple[FieldView, ...]:
        """What the form has beside the menu of outputs."""
        return ()

    def places(self) -> dict[str, str]:
        """The control that makes a part of the body, by the path of the part."""
        return {}

    def starters(self) -> Sequence[Starter | StudyExample]:
        """Links to ready studies: that of every example; a case of one's own needs none."""
        examples = () if self.asked.pairs else examples_of(self.calculation)
        path = f"{self.asked.path}/{self.link.name}"
        return [Starter(each.title, each.source, link(path, pairs_of(each.request))) for each in examples]

    @property
    def calculation(self) -> Calculation:
        """What it is a study of."""
        return self.asked.calculation

    @cached_property
    def case(self) -> dict[str, Any]:
        """The request with its defaults, as far as it can be read."""
        try:
            return self.asked.case
        except Unreadable:
            return {}

    @property
    def usual_output(self) -> Leaf:
        """The output that is shown when none is chosen."""
        response = self.calculation.response
        known = (leaf for path in self.outputs if (leaf := leaf_at(response, path)))
        return next(known, headlines(response)[0])

    @cached_property
    def output(self) -> Leaf:
        """The output that is shown; raises Unprocessable."""
        path = self.views.get("show") or self.usual_output.path
        output = scalar_at(self.calculation.response, path, "outputs.0", "unknown_output")
        if output.kind not in NUMBERS:
            raise Unprocessable("unknown_output", f"{output.path} is no number", "outputs.0")
        return output

    def number(self, control: str, usual: float | None = None) -> Any:
        """The number typed at a control, the usual one where it is empty; what is no number stays text."""
        text = self.views.get(control)
        return number_of(text) if text else usual

    def menu(self, name: str, label: str, empty: str, choices: list[Choice]) -> Menu:
        """A menu, whose choice may be one that it does not offer."""
        chosen = self.views.get(name, "")
        labels = {choice.path: choice.label for choice in choices}
        groups = [(group, list(items)) for group, items in groupby(choices, key=lambda choice: choice.group)]
        if chosen and chosen not in labels:
            groups.append(("asked for", [Choice(chosen, chosen, "")]))
        shown = labels.get(chosen, chosen) or empty
        return Menu(name, label, empty, chosen, shown, groups, dict(self.faults).get(name))

    def field(self, name: str, label: str, usual: Scalar = None, unit: str = "", options: Options = ()) -> FieldView:
        """What is typed, with what stands for it where it is left empty; or a choice of a few options."""
        return FieldView(
            name=name,
            label=label,
            unit=unit,
            widget="select" if options else "text" if isinstance(usual, str) else "number",
            text=self.views.get(name, ""),
            placeholder="" if usual is None else text_of(usual),
            options=options,
            fault=dict(self.faults).get(name),
        )

    def control_at(self, path: str) -> str:
        """The control that a path into the study means; a field of the case keeps its own name."""
        head, *rest = parts = path.split(".")
        if head == "request":
            return ".".join(rest)
        places = {"outputs": "show", **self.places()}
        above = (".".join(parts[:end]) for end in range(len(parts), 0, -1))
        return next((places[each] for each in above if each in places), path)

    def view(self, below: str) -> str:
        """The address of the page or of a view of the study."""
        views = {name: text for name, text in self.views.items() if name in STUDY_NAMES or name == "theme"}
        return link(f"{self.asked.path}/{self.link.name}{below}", self.asked.pairs, **views, sources=SHORT_SOURCES)

    @property
    def too_long(self) -> bool:
        """Whether a link cannot hold the study."""
        return len(self.view("").partition("?")[2]) > LONGEST_QUERY

    def image(self, figure: str, image_format: str) -> str:
        """The address of one figure as a file."""
        return self.view(f"/figures/{figure}.{image_format}")

    def input(self, path: str) -> Leaf:
        """The single value at a path of the request."""
        return scalar_at(self.calculation.request, path, "", "unknown_path")

    def address(self, overrides: Overrides, below: str = "") -> str:
        """Where the page of a point is, or a view of it."""
        body = with_overrides(self.calculation, self.asked.body, overrides)
        del body["detail"]
        return link(f"{self.asked.path}{below}", pairs_of(body), theme=self.views.get("theme", ""))

    def solved(self, overrides: Overrides) -> Case:
        """The case at a point with its answer, no more of it calculated than the outputs of the study need."""
        body = with_overrides(self.calculation, self.asked.body, overrides)
        outputs = [leaf.path for leaf in self.study.outputs]
        return solved(self.calculation, pairs_of(reduced_request(self.calculation.path, body, outputs)), None)


class Opened(NamedTuple):
    """A page around its result; one without a study is whole."""

    page: StudyPage
    status: int
    head: bytes
    tail: bytes


def opened(kind: type[StudyPage], asked: Asked, most: int, deadline_s: float) -> Opened:
    """The page of a study of a case, with the study if there is a case, or what it is refused for."""
    page, status = kind(asked), 200
    try:
        if asked.pairs and (not page.needs or any(asked.views.get(name) for name in page.needs)):
            page = checked(kind, asked, most, deadline_s)
    except REFUSED as error:
        status = 400 if isinstance(error, Unreadable) else 422
        found = faults_of(error, page.calculation)
        page.faults = [Fault(page.control_at(each.path), each.message) for each in found]
    show = page.menu("show", "output", page.usual_output.title, output_choices(page.calculation))
    groups = (*page.controls(), Controls("Show", show, page.shows()))
    controls = {each.name for group in groups for each in (group.menu, *group.fields) if each}
    theme = asked.views.get("theme", "")
    content = rendered(
        "study.html",
        asked.root,
        page=page,
        asked=asked,
        calculation=page.calculation,
        field_title=lambda path: title_of(page.calculation, path),
        outdated=asked.outdated,
        theme=theme,
        groups=groups,
        hidden=[pair for pair in (*asked.pairs, ("theme", theme)) if pair[1]],
        other_faults=[fault for fault in page.faults if fault.path not in controls],
        frames=FRAMES,
    )
    head, _, tail = content.partition(FRAMES)
    return Opened(page, status, head.encode(), tail.encode())


def checked(kind: type[StudyPage], asked: Asked, most: int, deadline_s: float) -> StudyPage:
    """The study that is asked for; raises what refuses it, with paths into the study."""
    page = kind(asked)
    page.study = page.plan(page.body(), most, deadline_s)
    return page


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
            choices.append(Choice(leaf.path, titled(leaf), group))
    return choices


def titled(leaf: Leaf) -> str:
    """The title of a field with its unit."""
    return f"{leaf.title}, {leaf.unit}" if leaf.unit else leaf.title


def drawn(page: StudyPage, lines: list[Line], done: int | None = None) -> bytes:
    """Figures, tables and links, of the first `done` points while the study runs.

    A study that ended early says why, and shows what it found.
    """
    *before, last = lines or [{"type": "progress"}]
    ended_early = last["type"] == "error"
    shows = last["type"] == "end" or (page.grows and (before if ended_early else lines))
    found = page.result(lines) if shows else Result("")
    charts = [embedded(name, figure, page.asked.theme) for name, figure in found.figures.items()]
    if charts:
        charts[0] = replace(charts[0], study=found.script)
    return rendered(
        "study_result.html",
        page.asked.root,
        page=page,
        found=found,
        problem=last["message"] if ended_early else "",
        done=last["done"] if ended_early else done,
        charts=charts,
        formats=MEDIA_TYPES,
    ).encode()


def file(page: StudyPage, lines: list[Line], name: str, image_format: Format) -> bytes | str:
    """One figure as a file, or why the study has none of this name."""
    found = page.result(lines)
    if name not in found.figures:
        return "; ".join([f"This study has the figures {', '.join(found.figures) or 'none'}", *found.remarks])
    return written(found.figures[name], image_format, page.asked.theme or "light")


def report(page: StudyPage, lines: list[Line], host: str) -> bytes:
    """The report of the case, with a section about the study."""
    section = {
        "title": page.link.label,
        "link": "" if page.too_long else page.view(""),
        "found": page.result(lines),
    }
    return case_report(page.asked, host, section).content
