"""Pages of studies: what is declared of each, what a page shows, the addresses of its views and points."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Generic, NamedTuple, TypeVar

from app.figures.data import Figure
from app.pages.cases import Case, solved
from app.pages.form import FieldView
from app.pages.links import LONGEST_QUERY
from app.pages.query import STUDY_NAMES, Pairs, body_of, link, pairs_of
from app.pages.study_links import StudyLink
from app.pages.views import Asked
from app.schema.fields import Leaf
from app.sources import SHORT_SOURCES
from app.studies.drive_train import lightened
from app.studies.points import with_overrides
from app.studies.requests import Overrides
from app.studies.stream import Line
from app.studies.study import Study

FRAMES = "<!-- the figures -->"
S = TypeVar("S")


@dataclass(frozen=True, slots=True)
class Opened(Generic[S]):
    """A page around its figures; without a study it is whole."""

    head: bytes
    tail: bytes = b""
    status: int = 200
    study: S | None = None


def around(page: str, study: S | None) -> Opened[S]:
    """A page cut where its figures come."""
    head, _, tail = page.partition(FRAMES)
    return Opened(head.encode(), tail.encode(), study=study)


@dataclass(frozen=True, slots=True)
class StudyAddresses:
    """The addresses of the views of a study, by the name of its page below that of the case."""

    name: str
    asked: Asked

    def view(self, below: str) -> str:
        """One of them."""
        said = {name: text for name, text in self.asked.views.items() if name in STUDY_NAMES or name == "theme"}
        return link(f"{self.asked.path}/{self.name}{below}", self.asked.pairs, **said, sources=SHORT_SOURCES)

    @property
    def too_long(self) -> bool:
        """Whether a link cannot hold the study."""
        return len(self.view("").partition("?")[2]) > LONGEST_QUERY

    def image(self, figure: str, image_format: str) -> str:
        """One figure as a file."""
        return self.view(f"/figures/{figure}.{image_format}")


def pairs_at(asked: Asked, overrides: Overrides) -> Pairs:
    """The fields of the case with a point's values."""
    body = with_overrides(asked.calculation, body_of(asked.calculation.request, asked.pairs), overrides)
    del body["detail"]
    return pairs_of(body)


def address_at(asked: Asked, overrides: Overrides, below: str = "") -> str:
    """Where the page of a point is, or a view of it."""
    return link(f"{asked.path}{below}", pairs_at(asked, overrides), theme=asked.views.get("theme", ""))


def case_at(asked: Asked, overrides: Overrides, outputs: list[str]) -> Case:
    """The case at a point with its answer, no more of it calculated than these outputs need."""
    body = body_of(asked.calculation.request, pairs_at(asked, overrides))
    return solved(asked.calculation, pairs_of(lightened(body, outputs)), None)


class Cell(NamedTuple):
    """A cell of a table: a text, with a link where it leads somewhere; numbers stand right."""

    text: str
    address: str = ""
    right: bool = False


class Table(NamedTuple):
    """A table under its title, and what there is to say of it."""

    title: str
    head: tuple[Cell, ...]
    rows: tuple[tuple[Cell, ...], ...]
    note: str = ""


class Lead(NamedTuple):
    """A link to go on from the result."""

    label: str
    address: str


@dataclass(frozen=True, slots=True)
class Result:
    """What a page shows of a study that came to its end; figures by their names."""

    progress: str
    figures: dict[str, Figure] = field(default_factory=dict)
    tables: tuple[Table, ...] = ()
    remarks: tuple[str, ...] = ()
    leads: tuple[Lead, ...] = ()


@dataclass(frozen=True, slots=True)
class PageStudy:
    """A study asked for on a page, of one output."""

    page: "StudyPage"
    asked: Asked
    output: Leaf
    study: Study


def no_fields(_said: dict[str, str], _faults: dict[str, str]) -> tuple[FieldView, ...]:
    """A form without fields."""
    return ()


@dataclass(frozen=True, slots=True)
class StudyPage:
    """A study with a page of its own.

    `output` is the path of the one shown when none is chosen, else the first headline. `body` makes what the study's
    endpoint is asked, `plan` checks it; `fields` are what the form has beside the output; `figures` names all it may
    show.
    """

    link: StudyLink
    question: str
    about: str
    figures: tuple[str, ...]
    body: Callable[[Asked, Leaf], dict[str, Any]]
    plan: Callable[[bytes, int, float], Study]
    result: Callable[[PageStudy, list[Line]], Result]
    output: str | None = None
    fields: Callable[[dict[str, str], dict[str, str]], tuple[FieldView, ...]] = no_fields
