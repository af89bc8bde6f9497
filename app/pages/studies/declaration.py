"""What is declared of a study's page, what it shows, and the addresses of its views and points."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any, NamedTuple

from app.figures.data import Figure
from app.pages.cases import Case, solved
from app.pages.form import FieldView
from app.pages.query import LONGEST_QUERY, STUDY_NAMES, link, pairs_of, text_of
from app.pages.study_links import Starter, StudyExample, StudyLink
from app.pages.templating import examples_of
from app.pages.typesetting import symbol
from app.pages.views import Asked
from app.schema.fields import Leaf
from app.sources import SHORT_SOURCES
from app.studies.engine import Line, Study
from app.studies.fields import scalar_at
from app.studies.points import reduced_request, with_overrides
from app.studies.requests import Overrides


@dataclass(frozen=True, slots=True)
class StudyAddresses:
    """The addresses of the views of a study, by the name of its page below that of the case."""

    name: str
    asked: Asked

    def view(self, below: str) -> str:
        """One of them."""
        views = {name: text for name, text in self.asked.views.items() if name in STUDY_NAMES or name == "theme"}
        return link(f"{self.asked.path}/{self.name}{below}", self.asked.pairs, **views, sources=SHORT_SOURCES)

    @property
    def too_long(self) -> bool:
        """Whether a link cannot hold the study."""
        return len(self.view("").partition("?")[2]) > LONGEST_QUERY

    def image(self, figure: str, image_format: str) -> str:
        """One figure as a file."""
        return self.view(f"/figures/{figure}.{image_format}")


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


@dataclass(frozen=True, slots=True)
class Form:
    """The form of a study of a case: what is wrong by control, and whether all of it was accepted."""

    asked: Asked
    faults: dict[str, str]
    accepted: bool

    def menu(self, name: str, label: str, empty: str, choices: list[Choice]) -> Menu:
        """A menu, whose choice may be one that it does not offer."""
        chosen = self.asked.views.get(name, "")
        labels = {choice.path: choice.label for choice in choices}
        groups = [(group, list(items)) for group, items in groupby(choices, key=lambda choice: choice.group)]
        if chosen and chosen not in labels:
            groups.append(("asked for", [Choice(chosen, chosen, "")]))
        shown = labels.get(chosen, chosen) or empty
        return Menu(name, label, empty, chosen, shown, groups, self.faults.get(name))

    def field(
        self,
        name: str,
        label: str,
        usual: float | str | None = None,
        unit: str = "",
        options: tuple[tuple[str, str], ...] = (),
    ) -> FieldView:
        """What is typed, with what stands for it where it is left empty; or a choice of a few options."""
        return FieldView(
            name=name,
            label=label,
            symbol=symbol(None),
            unit=unit,
            widget="select" if options else "text" if isinstance(usual, str) else "number",
            text=self.asked.views.get(name, ""),
            placeholder="" if usual is None else text_of(usual),
            options=options,
            required="",
            assumed=False,
            help=(),
            fault=self.faults.get(name),
        )


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
    rows: tuple[tuple[str | Link, ...], ...]
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


@dataclass(frozen=True, slots=True)
class PageStudy:
    """A study asked for on a page, of one output."""

    page: "StudyPage"
    asked: Asked
    output: Leaf
    study: Study

    @property
    def links(self) -> StudyAddresses:
        """Where the views of the study are."""
        return StudyAddresses(self.page.link.name, self.asked)

    def input(self, path: str) -> Leaf:
        """The single value at a path of the request."""
        return scalar_at(self.asked.calculation.request, path, "", "unknown_path")

    def address(self, overrides: Overrides, below: str = "") -> str:
        """Where the page of a point is, or a view of it."""
        body = with_overrides(self.asked.calculation, self.asked.body, overrides)
        del body["detail"]
        return link(f"{self.asked.path}{below}", pairs_of(body), theme=self.asked.views.get("theme", ""))

    def case(self, overrides: Overrides, outputs: list[str]) -> Case:
        """The case at a point with its answer, no more of it calculated than these outputs need."""
        body = with_overrides(self.asked.calculation, self.asked.body, overrides)
        reduced = reduced_request(self.asked.calculation.path, body, outputs)
        return solved(self.asked.calculation, pairs_of(reduced), None)


# Functions with names, because a page is pickled to the workers.
def nothing(_: Any) -> tuple[Any, ...]:
    """The controls that a page does without."""
    return ()


def starting_from_examples(name: str, asked: Asked) -> Sequence[Starter]:
    """The study of every example; a case of one's own needs none."""
    examples = () if asked.pairs else examples_of(asked.calculation)
    return [Starter(each.title, each.source, link(f"{asked.path}/{name}", pairs_of(each.request))) for each in examples]


@dataclass(frozen=True, slots=True)
class StudyPage:
    """A study with a page of its own.

    The output shown when none is chosen is the first of `outputs` that the answer has, else the first headline. `body`
    makes what the study's endpoint is asked, `plan` checks it; `most` is the setting that bounds its points.
    `controls` are what the form has beside the output, and `shows` beside the menu of outputs; `ranges` are the names
    of the controls of the uncertain inputs, in the order of the body. `result` is what the page shows of the lines of a
    study; with `grows` also of those that have come while it runs, else only how far it is. Without one of the controls
    in `needs` there is no study, and `choose` asks for it; `starters` are links to ready studies, made from the name of
    the page and the case. `figures` names all that there may be, `files` the forms in which the lines are offered.
    """

    link: StudyLink
    question: str
    about: str
    figures: tuple[str, ...]
    body: Callable[[Asked, Leaf], dict[str, Any]]
    plan: Callable[[dict[str, Any], int, float], Study]
    result: Callable[[PageStudy, list[Line]], Result]
    outputs: tuple[str, ...] = ()
    controls: Callable[[Form], tuple[Controls, ...]] = nothing
    shows: Callable[[Form], tuple[FieldView, ...]] = nothing
    grows: bool = False
    ranges: Callable[[Asked], Iterable[str]] = nothing
    most: str = "most_study_points"
    needs: tuple[str, ...] = ()
    choose: str = ""
    starters: Callable[[str, Asked], Sequence[Starter | StudyExample]] = starting_from_examples
    files: tuple[str, ...] = ("ndjson",)
